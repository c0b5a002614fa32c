#include "processes/redbee/evaluate/comparison.hpp"

#include <algorithm>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>

#include "redbee/files/input_error.hpp"
#include "redbee/files/input_file.hpp"
#include "redbee/files/json_file.hpp"

namespace redbee {
namespace {

namespace fs = std::filesystem;
using Fields = std::vector<std::string>;

void forEachLine(const fs::path& file, size_t least_fields, const std::function<void(const Fields&)>& take) {
  requireFile(file);
  std::ifstream in(file);
  if (!in) throw InputError(file, "cannot be read");
  int number = 0;
  bool any = false;
  for (std::string line; std::getline(in, line);) {
    ++number;
    std::istringstream stream(line.substr(0, line.find('#')));
    Fields fields;
    for (std::string field; stream >> field;) fields.push_back(field);
    if (fields.empty()) continue;
    if (fields.size() < least_fields) {
      throw InputError(
          file, number,
          "has " + std::to_string(fields.size()) + " fields, needs " + std::to_string(least_fields));
    }
    take(fields);
    any = true;
  }
  if (!any) throw InputError(file, "lists nothing");
}

CellMeasures readCell(const fs::path& folder) {
  CellMeasures cell;
  std::map<std::string, nlohmann::json> files;
  for (const MeasureName& measure : measureNames()) {
    const auto [file, is_new] = files.try_emplace(measure.file);
    if (is_new && fs::exists(folder / measure.file)) file->second = readJson(folder / measure.file);
    const nlohmann::json::json_pointer pointer(measure.pointer);
    if (file->second.contains(pointer) && file->second.at(pointer).is_number()) {
      cell.values[measure.name] = file->second.at(pointer).get<double>();
    }
  }
  return cell;
}

}  // namespace

const std::vector<MeasureName>& measureNames() {
  static const std::vector<MeasureName> names = {
      {"frames_limit", "measures.json", "/frames_limit"},
      {"labelled_frames", "measures.json", "/objects/labelled_frames"},
      {"error_at_half_recall", "measures.json", "/pixels/error_at_half_recall"},
      {"best_f1", "measures.json", "/pixels/best_f1"},
      {"precision", "measures.json", "/pixels/precision"},
      {"recall", "measures.json", "/pixels/recall"},
      {"f1", "measures.json", "/pixels/f1"},
      {"objects_present", "measures.json", "/objects/present"},
      {"objects_found", "measures.json", "/objects/found"},
      {"object_recall", "measures.json", "/objects/recall"},
      {"false_alarms_per_frame", "measures.json", "/objects/false_alarms_per_frame"},
      {"false_area_percent", "measures.json", "/objects/false_area_percent"},
      {"frames", "summary.json", "/frames"},
      {"fps", "summary.json", "/fps"},
      {"cpu_ms_per_frame", "summary.json", "/cpu_ms_per_frame"},
      {"peak_rss_bytes", "summary.json", "/peak_rss_bytes"},
      {"peak_heap_bytes", "heap.json", "/peak_heap_bytes"},
  };
  return names;
}

std::optional<double> CellMeasures::value(const std::string& name) const {
  const auto found = values.find(name);
  return found == values.end() ? std::nullopt : std::optional<double>(found->second);
}

std::vector<ListedClip> readClipList(const fs::path& file) {
  constexpr size_t kColumns = 6;  // set, name, import, recording, truth, configuration
  std::vector<ListedClip> clips;
  forEachLine(file, kColumns, [&](const Fields& fields) {
    clips.push_back({fields[0], fields[1], fields[5] == "extrinsics"});
  });
  return clips;
}

std::vector<std::string> readMethodList(const fs::path& file) {
  std::vector<std::string> methods;
  forEachLine(file, 2, [&](const Fields& fields) { methods.push_back(fields[0]); });
  return methods;
}

Comparison::Comparison(fs::path cells, std::vector<ListedClip> clips, std::vector<std::string> methods,
                       std::vector<std::string> extrinsics)
    : cells_(std::move(cells)),
      clips_(std::move(clips)),
      methods_(std::move(methods)),
      extrinsics_(std::move(extrinsics)) {
  for (const ListedClip& clip : clips_) {
    if (std::find(sets_.begin(), sets_.end(), clip.set) == sets_.end()) sets_.push_back(clip.set);
    for (const std::string& row : rowsOf(clip.set)) {
      for (const std::string& method : methods_) {
        const fs::path cell = folder(clip, row, method);
        if (fs::exists(cell / "measures.json")) measured_[cell] = readCell(cell);
      }
    }
  }
}

std::vector<ListedClip> Comparison::clipsOf(const std::string& set) const {
  std::vector<ListedClip> clips;
  std::copy_if(clips_.begin(), clips_.end(), std::back_inserter(clips),
               [&](const ListedClip& clip) { return clip.set == set; });
  return clips;
}

std::vector<std::string> Comparison::rowsOf(const std::string& set) const {
  const auto clips = clipsOf(set);
  const bool rows = std::any_of(clips.begin(), clips.end(),
                                [](const ListedClip& clip) { return clip.has_extrinsics_rows; });
  return rows ? extrinsics_ : std::vector<std::string>{kGivenExtrinsics};
}

fs::path Comparison::folder(const ListedClip& clip, const std::string& row, const std::string& method) const {
  return cells_ / clip.set / clip.name / (clip.has_extrinsics_rows ? row : kGivenExtrinsics) / method;
}

const CellMeasures* Comparison::cell(const ListedClip& clip, const std::string& row,
                                     const std::string& method) const {
  const auto found = measured_.find(folder(clip, row, method));
  return found == measured_.end() ? nullptr : &found->second;
}

}  // namespace redbee
