#include "processes/redbee/evaluate/measures_files.hpp"

#include <nlohmann/json.hpp>
#include <sstream>

#include "processes/redbee/pages/number.hpp"
#include "processes/redbee/pages/svg_plot.hpp"
#include "redbee/files/atomic_file.hpp"
#include "redbee/files/csv.hpp"
#include "redbee/files/json_file.hpp"

namespace redbee {
namespace {

nlohmann::json definedOnly(bool defined, const nlohmann::json& value) {
  return defined ? value : nlohmann::json();
}

nlohmann::json pixelJson(const ClipMeasures& clip) {
  const bool defined = clip.pixels.movingPixels() > 0;
  const OperatingPoint decided = clip.decided.at(1);
  const double sum = decided.precision + decided.recall;
  return {{"labelled_frames", clip.pixels.frames()},
          {"moving_pixels", clip.pixels.movingPixels()},
          {"error_at_half_recall", definedOnly(defined, clip.pixels.errorAtHalfRecall())},
          {"best_f1", definedOnly(defined, clip.pixels.bestF1())},
          {"precision", definedOnly(defined, decided.precision)},
          {"recall", definedOnly(defined, decided.recall)},
          {"region_similarity_j", definedOnly(defined, clip.regions.j())},
          {"contour_accuracy_f", definedOnly(defined, clip.regions.f())},
          {"f1", definedOnly(defined, sum > 0 ? 2 * decided.precision * decided.recall / sum : 0)}};
}

nlohmann::json objectJson(const ClipMeasures& clip) {
  const ObjectMeasures& objects = clip.objects;
  const bool defined = objects.counts().present > 0;
  return {{"labelled_frames", objects.frames()},
          {"present", objects.counts().present},
          {"found", objects.counts().found},
          {"recall", definedOnly(defined, objects.recall())},
          {"false_alarms_per_frame", objects.falseAlarmsPerFrame()},
          {"false_area_percent", 100 * objects.falseAreaFraction()}};
}

/// PESMOD's F1 of boxes, and the measures of tracks.
nlohmann::json trackJson(const TrackReport& report) {
  nlohmann::json json{{"least_visible_pixels", kLeastTrackedPixels}};
  for (const auto& [overlap, m] : report.overlaps) {
    const bool defined = m.truths > 0;
    const bool identified = defined && report.has_identities;
    json["iou_" + fixed(overlap, 2)] = {
        {"objects", m.truths},
        {"boxes", m.detections},
        {"recall", definedOnly(defined, m.recall)},
        {"false_boxes_per_frame", m.false_boxes_per_frame},
        {"f1", definedOnly(defined, 2.0 * static_cast<double>(m.matches) /
                                        static_cast<double>(m.truths + m.detections))},
        {"mean_iou", definedOnly(m.matches > 0, m.mean_overlap)},
        {"mota", definedOnly(identified, m.mota)},
        {"id_switches", definedOnly(identified, m.id_switches)},
        {"idf1", definedOnly(identified, m.idf1)},
        {"hota", definedOnly(identified, m.hota)},
        {"detection_accuracy", definedOnly(identified, m.detection_accuracy)},
        {"association_accuracy", definedOnly(identified, m.association_accuracy)}};
  }
  return json;
}

void writeBoxCurve(const std::filesystem::path& results, const TrackReport& report) {
  std::ostringstream csv;
  csv << "least_score,recall,false_boxes_per_frame\n";
  for (const BoxOperatingPoint& point : report.curve)
    csv << point.least_score << ',' << point.recall << ',' << point.false_boxes_per_frame << '\n';
  writeAtomically(results / "boxes.csv", csv.str());
}

void writeCurve(const std::filesystem::path& results, const ClipMeasures& clip) {
  std::ostringstream csv;
  csv << "threshold,precision,recall\n";
  std::vector<double> recall, precision;
  for (const OperatingPoint& point : clip.pixels.curve()) {
    csv << point.threshold << ',' << point.precision << ',' << point.recall << '\n';
    if (point.recall == 0) continue;  // nothing is found yet: precision is undefined
    recall.push_back(point.recall);
    precision.push_back(point.precision);
  }
  writeAtomically(results / "pr.csv", csv.str());
  SvgPlot plot(clip.name, "recall", "precision");
  plot.makeSquare(0, 1);
  plot.addLine("", recall, precision, "#1f618d");
  plot.addMark("half recall", 0.5);
  writeAtomically(results / "pr.svg", plot.svg());
}

void writeFrames(const std::filesystem::path& results, const ClipMeasures& clip) {
  std::ostringstream csv;
  csv << "utime,hit_px,false_px,missed_px,objects,found,false_alarms,false_area_px\n";
  for (const FrameOutcome& frame : clip.frames) {
    csv << frame.utime << ',' << frame.hits << ',' << frame.false_alarms << ',' << frame.misses << ','
        << frame.objects.present << ',' << frame.objects.found << ',' << frame.objects.false_alarms << ','
        << frame.objects.false_area << '\n';
  }
  writeAtomically(results / "frames.csv", csv.str());
}

}  // namespace

void writeMeasures(const std::filesystem::path& results, const ClipMeasures& clip) {
  writeFrames(results, clip);
  if (clip.tracks) writeBoxCurve(results, *clip.tracks);
  writeJson(results / "measures.json",
            {{"clip", clip.name},
             {"frames_limit", clip.frames_limit},
             {"truth_without_result", clip.truth_without_result},
             {"pixels", pixelJson(clip)},
             {"objects", objectJson(clip)},
             {"tracks", clip.tracks ? trackJson(*clip.tracks) : nlohmann::json()}});
  if (clip.pixels.movingPixels() > 0) {
    writeCurve(results, clip);
  } else {
    for (const char* stale : {"pr.csv", "pr.svg"}) std::filesystem::remove(results / stale);
  }
}

RecallPrecision readCurve(const std::filesystem::path& file) {
  constexpr size_t kColumns = 3;
  RecallPrecision curve;
  CsvReader csv(file);
  csv.next(kColumns);  // the names of the columns
  while (csv.next(kColumns)) {
    if (csv.number(2) == 0) continue;
    curve.precision.push_back(csv.number(1));
    curve.recall.push_back(csv.number(2));
  }
  return curve;
}

}  // namespace redbee
