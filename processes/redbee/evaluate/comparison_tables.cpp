#include <algorithm>
#include <functional>
#include <optional>
#include <sstream>

#include "processes/redbee/evaluate/compare.hpp"
#include "processes/redbee/pages/number.hpp"

namespace redbee {
namespace {

constexpr const char* kNone = "-";

/// A measure over clips: their mean, and over how many.
struct Mean {
  double sum = 0;
  int count = 0;
  void add(const std::optional<double>& value) {
    if (!value) return;
    sum += *value;
    ++count;
  }
  std::string text(int decimals, double scale = 1) const {
    return count > 0 ? fixed(scale * sum / count, decimals) : kNone;
  }
};

std::optional<double> valueOf(const CellMeasures* cell, const char* name) {
  return cell != nullptr ? cell->value(name) : std::nullopt;
}

Mean meanOf(const Comparison& comparison, const std::string& set, const std::string& row,
            const std::string& method, const char* name) {
  Mean mean;
  for (const ListedClip& clip : comparison.clipsOf(set))
    mean.add(valueOf(comparison.cell(clip, row, method), name));
  return mean;
}

bool anyCell(const Comparison& comparison, const std::string& set, const std::string& row, const char* name) {
  return std::any_of(
      comparison.methods().begin(), comparison.methods().end(),
      [&](const std::string& method) { return meanOf(comparison, set, row, method, name).count > 0; });
}

std::string headingOf(const std::string& set, const std::string& row) {
  return row == kGivenExtrinsics ? set : set + ", extrinsics " + row;
}

std::string textOf(const CellMeasures* cell, const char* name, int decimals, double scale = 1) {
  const auto value = valueOf(cell, name);
  return value ? fixed(scale * *value, decimals) : kNone;
}

std::string errorAndF1(const CellMeasures* cell) {
  const auto error = valueOf(cell, "error_at_half_recall");
  if (!error) return kNone;
  return fixed(*error, 3) + " / " + fixed(*valueOf(cell, "best_f1"), 3);
}

void noteUnfinished(const Comparison& comparison, const std::string& set, const std::string& row,
                    Table& table) {
  size_t missing = 0;
  for (const ListedClip& clip : comparison.clipsOf(set)) {
    for (const std::string& method : comparison.methods()) {
      if (comparison.cell(clip, row, method) == nullptr) ++missing;
    }
  }
  if (missing > 0)
    table.notes.push_back(std::to_string(missing) + " runs have no result; the means are without them");
}

/// A method that was run on fewer frames than the others must not be compared with them unnoticed.
void noteLimits(const Comparison& comparison, const std::string& set, const std::string& row, Table& table) {
  for (const std::string& method : comparison.methods()) {
    double limit = 0;
    for (const ListedClip& clip : comparison.clipsOf(set))
      limit = std::max(limit, valueOf(comparison.cell(clip, row, method), "frames_limit").value_or(0));
    if (limit > 0)
      table.notes.push_back(method + ": only the first " + fixed(limit, 0) + " frames of each clip");
  }
}

Table accuracyTable(const Comparison& comparison, const std::string& set, const std::string& row) {
  Table table;
  table.title = headingOf(set, row) + ": Error@50% / best F1";
  table.columns = {"method"};
  for (const ListedClip& clip : comparison.clipsOf(set)) table.columns.push_back(clip.name);
  table.columns.push_back("mean");
  for (const std::string& method : comparison.methods()) {
    std::vector<Cell> cells{method};
    for (const ListedClip& clip : comparison.clipsOf(set)) {
      cells.push_back(errorAndF1(comparison.cell(clip, row, method)));
    }
    const Mean error = meanOf(comparison, set, row, method, "error_at_half_recall");
    cells.push_back(error.count == 0
                        ? kNone
                        : error.text(3) + " / " + meanOf(comparison, set, row, method, "best_f1").text(3));
    table.rows.push_back(cells);
  }
  noteUnfinished(comparison, set, row, table);
  noteLimits(comparison, set, row, table);
  return table;
}

Table decisionTable(const Comparison& comparison, const std::string& set, const std::string& row) {
  Table table;
  table.title = headingOf(set, row) + ": at each method's own threshold, mean over clips";
  table.columns = {"method",          "precision",          "recall",      "F1",
                   "objects found %", "false alarms/frame", "false area %"};
  for (const std::string& method : comparison.methods()) {
    const auto mean = [&](const char* name, int decimals, double scale) {
      return meanOf(comparison, set, row, method, name).text(decimals, scale);
    };
    table.rows.push_back({method, mean("precision", 3, 1), mean("recall", 3, 1), mean("f1", 3, 1),
                          mean("object_recall", 1, 100), mean("false_alarms_per_frame", 2, 1),
                          mean("false_area_percent", 3, 1)});
  }
  noteLimits(comparison, set, row, table);
  return table;
}

Table objectTable(const Comparison& comparison, const std::string& set, const std::string& row) {
  Table table;
  table.title =
      headingOf(set, row) + ": objects found % / false alarms per frame / their area, % of the image";
  table.columns = {"method"};
  for (const ListedClip& clip : comparison.clipsOf(set)) table.columns.push_back(clip.name);
  for (const std::string& method : comparison.methods()) {
    std::vector<Cell> cells{method};
    for (const ListedClip& clip : comparison.clipsOf(set)) {
      const CellMeasures* cell = comparison.cell(clip, row, method);
      cells.push_back(textOf(cell, "object_recall", 1, 100) + " / " +
                      textOf(cell, "false_alarms_per_frame", 2) + " / " +
                      textOf(cell, "false_area_percent", 3));
    }
    table.rows.push_back(cells);
  }
  noteUnfinished(comparison, set, row, table);
  noteLimits(comparison, set, row, table);
  return table;
}

/// Frames of all clips over the time that the slowest stage took for them.
std::string framerate(const Comparison& comparison, const std::string& set, const std::string& row,
                      const std::string& method) {
  double frames = 0, seconds = 0;
  for (const ListedClip& clip : comparison.clipsOf(set)) {
    const CellMeasures* cell = comparison.cell(clip, row, method);
    const auto fps = valueOf(cell, "fps");
    if (!fps || *fps <= 0) continue;
    frames += *valueOf(cell, "frames");
    seconds += *valueOf(cell, "frames") / *fps;
  }
  return seconds > 0 ? fixed(frames / seconds, 1) : kNone;
}

Table costTable(const Comparison& comparison, const std::string& set, const std::string& row) {
  Table table;
  table.title = headingOf(set, row) + ": cost beside accuracy";
  table.columns = {"method", "frames/s", "CPU ms/frame", "Error@50%", "resident MB"};
  const bool heap = anyCell(comparison, set, row, "peak_heap_bytes");
  if (heap) table.columns.push_back("peak heap MB");
  for (const std::string& method : comparison.methods()) {
    const auto mean = [&](const char* name, int decimals, double scale) {
      return meanOf(comparison, set, row, method, name).text(decimals, scale);
    };
    table.rows.push_back({method, framerate(comparison, set, row, method), mean("cpu_ms_per_frame", 1, 1),
                          mean("error_at_half_recall", 3, 1), mean("peak_rss_bytes", 1, 1 / kMegabyte)});
    if (heap) table.rows.back().push_back(mean("peak_heap_bytes", 1, 1 / kMegabyte));
  }
  table.notes = {
      "frames/s: frames over wall time of the slowest stage, decoding included; meaningful only where "
      "nothing "
      "else was running (scripts/evaluate --table 3)",
      "CPU: decoding and all stages of the method, without reading the log, encoding the output messages and "
      "writing the results"};
  noteLimits(comparison, set, row, table);
  return table;
}

Table extrinsicsTable(const Comparison& comparison, const std::string& set) {
  Table table;
  table.title = set + ": Error@50% / best F1, mean over clips, by extrinsics";
  table.columns = {"method"};
  for (const std::string& row : comparison.rowsOf(set)) table.columns.push_back(row);
  for (const std::string& method : comparison.methods()) {
    std::vector<Cell> cells{method};
    for (const std::string& row : comparison.rowsOf(set)) {
      const Mean error = meanOf(comparison, set, row, method, "error_at_half_recall");
      cells.push_back(error.count == 0
                          ? kNone
                          : error.text(3) + " / " + meanOf(comparison, set, row, method, "best_f1").text(3));
    }
    table.rows.push_back(cells);
  }
  return table;
}

}  // namespace

std::vector<Table> comparisonTables(const Comparison& comparison) {
  std::vector<Table> tables;
  for (const std::string& set : comparison.sets()) {
    const auto rows = comparison.rowsOf(set);
    for (const std::string& row : rows) {
      if (anyCell(comparison, set, row, "error_at_half_recall")) {
        tables.push_back(accuracyTable(comparison, set, row));
        tables.push_back(decisionTable(comparison, set, row));
      }
      tables.push_back(objectTable(comparison, set, row));
      tables.push_back(costTable(comparison, set, row));
    }
    if (rows.size() > 1) tables.push_back(extrinsicsTable(comparison, set));
  }
  return tables;
}

std::string comparisonCsv(const Comparison& comparison) {
  std::ostringstream csv;
  csv << "set,clip,extrinsics,method,measure,value\n";
  csv.precision(9);
  for (const std::string& set : comparison.sets()) {
    for (const ListedClip& clip : comparison.clipsOf(set)) {
      for (const std::string& row : comparison.rowsOf(set)) {
        for (const std::string& method : comparison.methods()) {
          const CellMeasures* cell = comparison.cell(clip, row, method);
          if (cell == nullptr) continue;
          for (const auto& [name, value] : cell->values) {
            csv << set << ',' << clip.name << ',' << row << ',' << method << ',' << name << ',' << value
                << '\n';
          }
        }
      }
    }
  }
  return csv.str();
}

}  // namespace redbee
