#include "processes/redbee/evaluate/report.hpp"

#include <cstdarg>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <sstream>

#include "processes/redbee/evaluate/evaluate.hpp"
#include "processes/redbee/evaluate/measures_files.hpp"
#include "processes/redbee/evaluate/overlay_video.hpp"
#include "processes/redbee/pages/html.hpp"
#include "redbee/files/atomic_file.hpp"

namespace redbee {
namespace {

constexpr int kImages = 6;
constexpr const char* kStyle =
    "body{font:15px/1.5 sans-serif;max-width:1040px;margin:2em auto;padding:0 1em;color:#222}"
    "table{border-collapse:collapse}td,th{padding:.25em .8em;border-bottom:1px solid #ddd;text-align:right}"
    "td:first-child,th:first-child{text-align:left}img{width:49%;margin:.2%}h1{font-size:1.4em}h2{font-size:"
    "1.1em}";

std::string format(const char* pattern, ...) __attribute__((format(printf, 1, 2)));
std::string format(const char* pattern, ...) {
  char text[512];
  va_list arguments;
  va_start(arguments, pattern);
  std::vsnprintf(text, sizeof text, pattern, arguments);
  va_end(arguments);
  return text;
}

std::vector<std::string> stageRows(const nlohmann::json& summary) {
  std::vector<std::string> rows;
  for (const auto& [process, stage] : summary.at("stages").items()) {
    rows.push_back(format("%-28s %7lld %9.2f %9.2f %8lld %6lld %9.1f", process.c_str(),
                          stage.at("frames").get<long long>(), stage.at("median_ms").get<double>(),
                          stage.at("p99_ms").get<double>(), stage.at("skipped").get<long long>(),
                          stage.at("lost").get<long long>(),
                          stage.at("resident_bytes").get<double>() / 1048576));
  }
  return rows;
}

std::vector<std::string> headlines(const nlohmann::json& summary,
                                   const std::optional<ClipMeasures>& measures) {
  std::vector<std::string> lines;
  lines.push_back(format("frames %lld (%lld with a mask), lost %lld, skipped %lld, waited for in vain %lld",
                         summary.at("frames").get<long long>(), summary.at("frames_good").get<long long>(),
                         summary.at("lost").get<long long>(), summary.at("skipped").get<long long>(),
                         summary.at("given_up").get<long long>()));
  lines.push_back(format("%.1f frames a second in the slowest stage, %.1f MB resident",
                         summary.at("fps").get<double>(),
                         summary.at("peak_rss_bytes").get<double>() / 1048576));
  if (measures) {
    lines.push_back(format("against the truth masks: Error@50%% %.3f, best F1 %.3f over %lld frames",
                           measures->pixels.errorAtHalfRecall(), measures->pixels.bestF1(),
                           static_cast<long long>(measures->pixels.frames())));
  }
  return lines;
}

std::string images(const ReportOptions& options, int64_t frames) {
  std::string html;
  const int64_t period = std::max<int64_t>(1, frames / kImages);
  int64_t count = 0;
  forEachOverlay(options.log, options.configuration, options.results, [&](int64_t, const cv::Mat& drawn) {
    if (count++ % period != period / 2) return;
    std::vector<uint8_t> jpeg;
    cv::imencode(".jpg", drawn, jpeg, {cv::IMWRITE_JPEG_QUALITY, 85});
    html += jpegElement({reinterpret_cast<const char*>(jpeg.data()), jpeg.size()}, "overlay") + "\n";
  });
  return html;
}

std::string tableHtml(const nlohmann::json& summary) {
  std::string html =
      "<table><tr><th>process</th><th>frames</th><th>median ms</th><th>p99 "
      "ms</th><th>skipped</th><th>lost</th>"
      "<th>resident MB</th></tr>\n";
  for (const std::string& row : stageRows(summary)) {
    std::istringstream words(row);
    html += "<tr>";
    for (std::string word; words >> word;) html += "<td>" + word + "</td>";
    html += "</tr>\n";
  }
  return html + "</table>\n";
}

}  // namespace

void writeReport(const ReportOptions& options) {
  const nlohmann::json summary = readJson(options.results / "summary.json");
  std::optional<ClipMeasures> measures;
  if (!options.truth.empty()) measures = measureClip({options.truth, options.results, {}});

  std::ostringstream html;
  html << "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><title>REDBEE: "
       << options.log.filename().string() << "</title><style>" << kStyle
       << "</style>\n<h1>REDBEE " REDBEE_VERSION ": " << options.log.filename().string() << "</h1>\n<ul>\n";
  std::printf("\nREDBEE " REDBEE_VERSION ", %s\n", options.log.filename().c_str());
  for (const std::string& line : headlines(summary, measures)) {
    html << "<li>" << line << "</li>\n";
    std::printf("  %s\n", line.c_str());
  }
  std::printf("  %-28s %7s %9s %9s %8s %6s %9s\n", "process", "frames", "median ms", "p99 ms", "skipped",
              "lost", "MB");
  for (const std::string& row : stageRows(summary)) std::printf("  %s\n", row.c_str());
  html << "</ul>\n<h2>Processes</h2>\n"
       << tableHtml(summary) << "<h2>What moves</h2>\n"
       << images(options, summary.at("frames").get<int64_t>()) << "</html>\n";
  writeAtomically(options.page, html.str());
  std::printf("%s\n", options.page.c_str());
}

}  // namespace redbee
