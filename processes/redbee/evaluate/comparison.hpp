// The runs of scripts/evaluate: one folder of results for each clip, method and variant of the extrinsics.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace redbee {

/// One line of a list of clips: set and name; the remaining fields are for scripts/evaluate. Clips without an
/// IMU calibration of their own have one variant of the extrinsics, `given`.
struct ListedClip {
  std::string set;
  std::string name;
  bool has_extrinsics_rows = false;
};

/// Lines of fields separated by blanks; '#' starts a comment. Throw InputError with file and line.
std::vector<ListedClip> readClipList(const std::filesystem::path& file);
/// The first field of each line.
std::vector<std::string> readMethodList(const std::filesystem::path& file);

/// Measures of one run; missing: undefined with this truth, or not measured.
struct CellMeasures {
  std::map<std::string, double> values;  ///< by the names in measureNames()
  std::optional<double> value(const std::string& name) const;
};

/// Column names of cells.csv, each a member of a cell's JSON files.
struct MeasureName {
  const char* name;
  const char* file;     ///< measures.json, summary.json
  const char* pointer;  ///< JSON pointer
};
const std::vector<MeasureName>& measureNames();

inline constexpr const char* kGivenExtrinsics = "given";

class Comparison {
 public:
  /// Cells are folders cells/SET/CLIP/EXTRINSICS/METHOD. A cell without measures.json has not been run yet.
  Comparison(std::filesystem::path cells, std::vector<ListedClip> clips, std::vector<std::string> methods,
             std::vector<std::string> extrinsics);

  const std::vector<std::string>& methods() const { return methods_; }
  const std::vector<std::string>& sets() const { return sets_; }
  std::vector<ListedClip> clipsOf(const std::string& set) const;
  /// The variants of the extrinsics that the set's clips have.
  std::vector<std::string> rowsOf(const std::string& set) const;
  std::filesystem::path folder(const ListedClip& clip, const std::string& row,
                               const std::string& method) const;
  /// nullptr if the cell has not been run.
  const CellMeasures* cell(const ListedClip& clip, const std::string& row, const std::string& method) const;

 private:
  std::filesystem::path cells_;
  std::vector<ListedClip> clips_;
  std::vector<std::string> methods_;
  std::vector<std::string> extrinsics_;
  std::vector<std::string> sets_;
  std::map<std::filesystem::path, CellMeasures> measured_;
};

}  // namespace redbee
