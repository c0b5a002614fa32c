#include "redbee/results/homography_csv.hpp"

#include <spdlog/fmt/fmt.h>

#include "redbee/files/csv.hpp"

namespace redbee {
namespace {

constexpr size_t kGround = 2, kFront = 11, kSource = 20, kColumns = 21;

/// Nine fields with a comma before each; enough digits to read back the same numbers.
std::string entries(const std::optional<Eigen::Matrix3d>& H) {
  std::string text;
  for (int i = 0; i < 9; ++i) text += H ? fmt::format(",{:.17g}", (*H)(i / 3, i % 3)) : ",";
  return text;
}

std::optional<Eigen::Matrix3d> entriesAt(const CsvReader& csv, size_t column) {
  if (csv.fields()[column].empty()) return std::nullopt;
  Eigen::Matrix3d H;
  for (int i = 0; i < 9; ++i) H(i / 3, i % 3) = csv.number(column + static_cast<size_t>(i));
  return H;
}

}  // namespace

HomographyCsv::HomographyCsv(const std::filesystem::path& file) : file_(file) {
  std::string header = "utime,epoch";
  for (const char* plane : {"ground", "front"}) {
    for (int i = 0; i < 9; ++i) header += fmt::format(",{}_h{}{}", plane, i / 3 + 1, i % 3 + 1);
  }
  file_.write(header + ",source\n");
}

void HomographyCsv::write(int64_t utime, const FrameHomographies& row) {
  file_.write(
      fmt::format("{},{}{}{},{}\n", utime, row.epoch, entries(row.ground), entries(row.front), row.source));
}

std::map<int64_t, FrameHomographies> readHomographies(const std::filesystem::path& file) {
  std::map<int64_t, FrameHomographies> rows;
  CsvReader csv(file);
  csv.next(kColumns);  // the names of the columns
  while (csv.next(kColumns)) {
    rows[csv.integer(0)] = {static_cast<int32_t>(csv.integer(1)), entriesAt(csv, kGround),
                            entriesAt(csv, kFront), csv.fields()[kSource]};
  }
  return rows;
}

}  // namespace redbee
