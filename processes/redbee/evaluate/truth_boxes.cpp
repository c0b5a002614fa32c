#include "processes/redbee/evaluate/truth_boxes.hpp"

#include "redbee/files/csv.hpp"

namespace redbee {
namespace {

namespace fs = std::filesystem;

TruthObject boxAt(const CsvReader& csv, size_t x) {
  TruthObject object;
  object.box = {csv.number(x), csv.number(x + 1), csv.number(x + 2), csv.number(x + 3)};
  return object;
}

/// MOT16's classes: pedestrian, person on a vehicle, car, bicycle, motorbike; -1: not stated.
bool movesByClass(int64_t object_class) {
  return object_class == -1 || (object_class >= 1 && object_class <= 5);
}

}  // namespace

TruthBoxes readBoxes(const fs::path& file) {
  constexpr size_t kColumns = 9;
  TruthBoxes boxes;
  CsvReader csv(file);
  csv.next(kColumns);  // the names of the columns
  while (csv.next(kColumns)) {
    TruthObject object = boxAt(csv, 5);
    object.id = static_cast<int>(csv.integer(2));
    object.counts = csv.fields()[4] == "moving";
    boxes.emplace(csv.integer(0), object);
  }
  return boxes;
}

TruthBoxes readIgnoredBoxes(const fs::path& file) {
  constexpr size_t kColumns = 5;
  TruthBoxes boxes;
  if (!fs::exists(file)) return boxes;
  CsvReader csv(file);
  csv.next(kColumns);  // the names of the columns
  while (csv.next(kColumns)) boxes.emplace(csv.integer(0), boxAt(csv, 1));
  return boxes;
}

TruthBoxes readMotBoxes(const fs::path& file) {
  constexpr size_t kLeastColumns = 6;
  TruthBoxes boxes;
  CsvReader csv(file);
  while (csv.next(0)) {
    if (csv.fields().size() < kLeastColumns)
      csv.fail("has " + std::to_string(csv.fields().size()) +
               " columns; MOT's gt.txt has frame, id, x, y, w, h, counts, class, visibility");
    if (csv.integer(0) < 1) csv.fail("frame " + csv.fields()[0] + ": MOT counts frames from 1");
    TruthObject object = boxAt(csv, 2);
    object.box.x -= 1;
    object.box.y -= 1;
    object.id = static_cast<int>(csv.integer(1));
    const bool counts = csv.fields().size() < 7 || csv.number(6) != 0;
    const bool moves = csv.fields().size() < 8 || movesByClass(csv.integer(7));
    object.counts = counts && moves;
    boxes.emplace(csv.integer(0) - 1, object);
  }
  return boxes;
}

std::optional<fs::path> motFileIn(const fs::path& folder) {
  for (const fs::path& file : {folder / "gt" / "gt.txt", folder / "gt.txt"}) {
    if (fs::is_regular_file(file)) return file;
  }
  return std::nullopt;
}

}  // namespace redbee
