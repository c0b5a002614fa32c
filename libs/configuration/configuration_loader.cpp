#include "redbee/configuration/configuration_loader.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "redbee/configuration/configuration_preset.hpp"
#include "redbee/configuration/configuration_table.hpp"
#include "redbee/configuration/configuration_value.hpp"
#include "redbee/configuration/renamed_keys.hpp"
#include "redbee/configuration/wait_order.hpp"
#include "redbee/files/input_file.hpp"
#include "redbee/image_codec/image_codec.hpp"

namespace redbee::configuration {
namespace {

bool isDirective(const std::string& key) { return key == "include" || key == "preset"; }

double waitOf(const Configuration& configuration, const std::string& key) {
  return YAML::Load(findSetting(key)->text(configuration)).as<double>();
}

/// yaml-cpp's messages may have several lines, and so may a key in the file.
std::string oneLine(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

}  // namespace

void Loader::fail(const Place& place, const std::string& key, const std::string& what) {
  const std::string line = place.line > 0 ? ":" + std::to_string(place.line) : "";
  throw ConfigurationError(place.file + line + ": " + oneLine(key + ": " + what));
}

Loader::Place Loader::placeOf(const YAML::Node& node) const {
  return {open_files_.back().string(), std::max(node.Mark().line, 0) + 1};
}

void Loader::loadFile(const std::filesystem::path& file) {
  YAML::Node root;
  if (const std::string fault = faultOfInput(file); !fault.empty()) fail({file.string(), 0}, "file", fault);
  try {
    root = YAML::LoadFile(file.string());
  } catch (const YAML::BadFile&) {
    fail({file.string(), 1}, "file", "cannot be read");
  } catch (const YAML::Exception& error) {
    fail({file.string(), std::max(error.mark.line, 0) + 1}, "syntax", error.msg);
  }
  open_files_.push_back(file);
  files_.push_back(file);
  if (!root.IsMap()) fail(placeOf(root), "file", "holds no keys");
  applyIncludes(root);
  applyPreset(root);
  applySection(root, "");
  open_files_.pop_back();
}

void Loader::applyIncludes(const YAML::Node& root) {
  const YAML::Node includes = root["include"];
  if (!includes) return;
  if (!includes.IsSequence()) return includeOne(includes);
  for (const auto& name : includes) includeOne(name);
}

void Loader::includeOne(const YAML::Node& name) {
  if (!name.IsScalar()) fail(placeOf(name), "include", "must be a file name or a list of them");
  const std::filesystem::path file = open_files_.back().parent_path() / name.Scalar();
  std::error_code error;
  if (const std::string fault = faultOfInput(file); !fault.empty())
    fail(placeOf(name), "include", file.string() + " " + fault);
  const bool open = std::any_of(open_files_.begin(), open_files_.end(), [&](const auto& other) {
    return std::filesystem::equivalent(file, other, error);
  });
  if (open) fail(placeOf(name), "include", file.string() + " includes itself");
  loadFile(file);
}

void Loader::applyPreset(const YAML::Node& root) {
  const YAML::Node name = root["preset"];
  if (!name) return;
  applyPreset(name.IsScalar() ? name.Scalar() : "", placeOf(name));
}

void Loader::applyPreset(const std::string& name, const Place& place) {
  const PresetValues* preset = findPreset(name);
  if (preset == nullptr) fail(place, "preset", "must be one of " + listOf(presetNames()));
  for (const auto& [key, text] : *preset) apply(key, YAML::Load(text), place);
}

void Loader::applyOverrides(const ConfigurationOverrides& overrides) {
  const Place place{"command line", 0};
  if (!overrides.preset.empty()) applyPreset(overrides.preset, place);
  for (const std::string& setting : overrides.settings) {
    const size_t equals = setting.find('=');
    if (equals == std::string::npos) fail(place, setting, "expected key=value");
    const std::string key = setting.substr(0, equals);
    if (findSetting(key) == nullptr) fail(place, key, unknownKey(key));
    try {
      apply(key, YAML::Load(setting.substr(equals + 1)), place);
    } catch (const YAML::Exception& error) {
      fail(place, key, error.msg);
    }
  }
}

void Loader::applySection(const YAML::Node& section, const std::string& prefix) {
  std::set<std::string> seen;
  for (const auto& entry : section) {
    const std::string key = prefix + (entry.first.IsScalar() ? entry.first.Scalar() : "?");
    if (!seen.insert(key).second) fail(placeOf(entry.first), key, "stands here for the second time");
    applyEntry(entry.first, entry.second, key);
  }
}

void Loader::applyEntry(const YAML::Node& name, const YAML::Node& value, const std::string& key) {
  if (isDirective(key)) return;
  if (findSetting(key) != nullptr) return apply(key, value, placeOf(name));
  if (!isSection(key) && !isRenamedSection(key)) fail(placeOf(name), key, unknownKey(key));
  if (!value.IsMap()) fail(placeOf(name), key, "is a section and must hold keys");
  applySection(value, key + ".");
}

void Loader::apply(const std::string& key, const YAML::Node& value, const Place& place) {
  try {
    findSetting(key)->read(configuration_, value);
  } catch (const ValueError& error) {
    fail(place, key, error.what());
  }
  places_[key] = place;
  if (key == "camera.mask" && !configuration_.mask.empty()) {
    // Beside the file that names it; from then on the same wherever it is read.
    const std::filesystem::path folder =
        place.line == 0 ? std::filesystem::path() : std::filesystem::path(place.file).parent_path();
    configuration_.mask = std::filesystem::absolute(folder / configuration_.mask).lexically_normal().string();
  }
}

void Loader::loadMask() {
  constexpr double kMostOfImage = 0.9;
  const std::string key = "camera.mask";
  const std::string& name = configuration_.mask;
  if (name.empty()) return;
  files_.emplace_back(name);
  const Place& place = places_.at(key);
  if (const std::string fault = faultOfInput(name); !fault.empty()) fail(place, key, name + " " + fault);
  const cv::Mat1b image = decodeGreyImage(readWhole(name));
  if (image.empty()) fail(place, key, name + " is neither a PNG nor a JPEG image, or damaged");
  const auto size = [](int width, int height) {
    return std::to_string(width) + "x" + std::to_string(height);
  };
  const CameraIntrinsics& camera = configuration_.camera;
  if (image.cols != camera.width || image.rows != camera.height) {
    fail(place, key,
         name + " has " + size(image.cols, image.rows) + " px, the camera " +
             size(camera.width, camera.height));
  }
  configuration_.own_parts = image >= 128;
  const double covered = cv::countNonZero(configuration_.own_parts) / static_cast<double>(image.total());
  if (covered > kMostOfImage)
    fail(place, key, name + " leaves less than a tenth of the image: white are the vehicle's own parts");
  if (covered == 0) fail(place, key, name + " marks nothing: white are the vehicle's own parts");
}

void Loader::checkWhole(const std::filesystem::path& file) const {
  checkCamera();
  for (const char* key :
       {"camera.width", "camera.height", "camera.fx", "camera.fy", "camera.cx", "camera.cy"}) {
    if (places_.count(key) == 0) fail({file.string(), 1}, key, "is missing");
  }
  std::map<std::string, std::string> key_of_channel;
  for (const auto& setting : settings()) {
    if (setting.key.rfind("channels.", 0) != 0) continue;
    const std::string name = setting.text(configuration_);
    const auto [first, is_new] = key_of_channel.emplace(name, setting.key);
    if (is_new) continue;
    // The name may be a default that no file sets.
    const auto place =
        places_.count(setting.key) > 0 ? places_.find(setting.key) : places_.find(first->second);
    fail(place->second, place->first,
         "channel name " + name + " is used twice, by " + first->second + " and " + setting.key);
  }
  checkWaits();
  checkThresholds();
  checkMount();
}

/// Of two keys that contradict each other, the one to report: that of the command line, else the first that a
/// file sets; the other may be a default.
const std::string& Loader::changed(const std::string& first, const std::string& second) const {
  const auto at = places_.find(second);
  const bool second_overrides = at != places_.end() && at->second.line == 0;
  return second_overrides || places_.count(first) == 0 ? second : first;
}

/// Otherwise the failure of one process would make both the process that waits for it and the next one in the
/// chain time out.
void Loader::checkWaits() const {
  for (const WaitOrder& order : waitOrders()) {
    const double longer = waitOf(configuration_, order.longer);
    const double shorter = waitOf(configuration_, order.shorter);
    if (shorter == 0 || longer > shorter) continue;
    const std::string& key = changed(order.longer, order.shorter);
    fail(places_.at(key), key,
         order.longer + " (" + valueText(longer) + " s) must be longer than " + order.shorter + " (" +
             valueText(shorter) + " s): " + order.reason);
  }
}

/// Model and coefficients may come from different files.
void Loader::checkCamera() const {
  const CameraIntrinsics& camera = configuration_.camera;
  const std::string fault = coefficientFault(*findCameraModel(camera.model), camera.distortion.size());
  if (fault.empty()) return;
  const bool stated = places_.count("camera.distortion") > 0;
  fail(places_.at(stated ? "camera.distortion" : "camera.model"), "camera.distortion", fault);
}

/// Targets would be placed by a camera that is fixed.
void Loader::checkMount() const {
  const GeolocationParameters& geolocation = configuration_.geolocation;
  if (!configuration_.inertial.gimbal.enabled || !geolocation.enabled || geolocation.mount == "gimbal")
    return;
  const std::string mount = "geolocation.mount", gimbal = "gimbal.enabled";
  const std::string& key = changed(mount, gimbal);
  fail(places_.at(key), key, "gimbal.enabled is true, so geolocation.mount must be gimbal");
}

void Loader::checkThresholds() const {
  const ObjectParameters& objects = configuration_.detection.objects;
  const std::string upper = "detection.objects.threshold";
  const std::map<std::string, double> lower_ones{
      {"detection.objects.weak_threshold", objects.weak_threshold},
      {"detection.objects.extent_threshold", objects.extent_threshold}};
  for (const auto& [lower, value] : lower_ones) {
    if (value <= objects.threshold) continue;
    const std::string& key = changed(lower, upper);
    std::string fault = lower;
    fault.append(" (").append(valueText(value)).append(") must not exceed ").append(upper);
    fault.append(" (").append(valueText(objects.threshold)).append(")");
    fail(places_.at(key), key, fault);
  }
}

}  // namespace redbee::configuration
