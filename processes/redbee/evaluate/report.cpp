#include "processes/redbee/evaluate/report.hpp"

#include <spdlog/fmt/fmt.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "processes/redbee/evaluate/evaluate.hpp"
#include "processes/redbee/evaluate/overlay_video.hpp"
#include "processes/redbee/pages/number.hpp"
#include "processes/redbee/pages/page.hpp"
#include "redbee/bus/build_version.hpp"
#include "redbee/configuration/configuration_files.hpp"
#include "redbee/files/atomic_file.hpp"
#include "redbee/files/input_file.hpp"
#include "redbee/geometry/time.hpp"
#include "redbee/image_codec/jpeg.hpp"
#include "redbee/process_health_t.hpp"
#include "redbee/results/run_folder.hpp"

namespace redbee {
namespace {

constexpr int kImages = 6;

std::string count(const nlohmann::json& json, const char* key) {
  return std::to_string(json.at(key).get<int64_t>());
}

std::string megabytes(const nlohmann::json& json, const char* key) {
  return fixed(json.at(key).get<double>() / kMegabyte, 1);
}

Table processTable(const nlohmann::json& summary) {
  Table table;
  table.columns = {"process", "frames", "median ms", "p99 ms", "skipped", "lost", "resident MB"};
  for (const auto& [process, stage] : summary.at("stages").items()) {
    table.rows.push_back({process, count(stage, "frames"), fixed(stage.at("median_ms").get<double>(), 2),
                          fixed(stage.at("p99_ms").get<double>(), 2), count(stage, "skipped"),
                          count(stage, "lost"), megabytes(stage, "resident_bytes")});
  }
  return table;
}

std::vector<std::string> headlines(const nlohmann::json& summary,
                                   const std::optional<ClipMeasures>& measures) {
  std::vector<std::string> lines{
      fmt::format("{} frames ({} with a mask), {} lost, {} skipped, {} timed out", count(summary, "frames"),
                  count(summary, "frames_good"), count(summary, "lost"), count(summary, "skipped"),
                  count(summary, "timed_out")),
      fmt::format("{:.1f} frames per second in the slowest stage, {} MB resident",
                  summary.at("fps").get<double>(), megabytes(summary, "peak_rss_bytes"))};
  for (const auto& [process, stage] : summary.at("stages").items()) {
    const std::string message = stage.value("message", "");
    if (stage.value("state", 0) == process_health_t::DEGRADED && !message.empty())
      lines.push_back(fmt::format("at the end, {}: {}", process, message));
  }
  if (measures) {
    lines.push_back(fmt::format("against ground truth: Error@50% {:.3f}, best F1 {:.3f} over {} frames",
                                measures->pixels.errorAtHalfRecall(), measures->pixels.bestF1(),
                                measures->pixels.frames()));
  }
  return lines;
}

std::vector<std::string> overlays(const ReportOptions& options, int64_t frames) {
  std::vector<std::string> figures;
  const int64_t period = std::max<int64_t>(1, frames / kImages);
  int64_t number = 0;
  int64_t first_utime = 0;
  forEachOverlay(
      options.log, options.configuration, options.results, [&](int64_t utime, const cv::Mat& drawn) {
        if (number == 0) first_utime = utime;
        if (number++ % period != period / 2) return;
        const std::vector<uint8_t> jpeg = encodeJpeg(drawn, 85);
        figures.push_back(
            jpegFigure({reinterpret_cast<const char*>(jpeg.data()), jpeg.size()},
                       fmt::format("frame {}, {:.2f} s", number, seconds(fromUtime(utime - first_utime)))));
      });
  return figures;
}

void printIndented(const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) std::printf("  %s\n", line.c_str());
}

}  // namespace

void writeReport(const ReportOptions& options) {
  requireNoInput(options.page, options.configuration, {options.log});
  checkWritable(options.page);
  const nlohmann::json summary = RunFolder(options.results).summary();
  std::optional<ClipMeasures> measures;
  if (!options.truth.empty()) measures = measureClip({options.truth, options.results, {}});
  const std::vector<std::string> lines = headlines(summary, measures);
  const Table processes = processTable(summary);

  Page page(std::string("REDBEE ") + releaseVersion() + ": " + options.log.filename().string());
  page.addList(lines);
  page.addHeading("Processes");
  page.addTable(processes);
  page.addHeading("Detections");
  page.addFigures(overlays(options, summary.at("frames").get<int64_t>()), 2);
  writeAtomically(options.page, page.html());

  std::printf("\nREDBEE %s, %s\n", releaseVersion(), options.log.filename().c_str());
  for (const std::string& line : lines) std::printf("  %s\n", line.c_str());
  printIndented(asText(processes));
  std::printf("%s\n", options.page.c_str());
}

}  // namespace redbee
