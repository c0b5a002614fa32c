#include "processes/camera/gstreamer/pipeline_fault.hpp"

#include <algorithm>
#include <memory>

namespace redbee {
namespace {

struct FreeError {
  void operator()(GError* error) const { g_error_free(error); }
};

struct ElementPackage {
  const char* name;  // begins so
  const char* package;
};
// Elements of cameras that scripts/packages-camera.txt does not bring, and those of its packages.
constexpr ElementPackage kPackages[] = {
    {"jpegparse", "gstreamer1.0-plugins-bad"},  {"v4l2sl", "gstreamer1.0-plugins-bad"},
    {"videoflip", "gstreamer1.0-plugins-good"}, {"videocrop", "gstreamer1.0-plugins-good"},
    {"videobox", "gstreamer1.0-plugins-good"},  {"videobalance", "gstreamer1.0-plugins-good"},
    {"avdec_", "gstreamer1.0-libav"},           {"libcamerasrc", "gstreamer1.0-libcamera"},
    {"h264parse", "gstreamer1.0-plugins-bad"},  {"h265parse", "gstreamer1.0-plugins-bad"},
    {"srtsrc", "gstreamer1.0-plugins-bad"},     {"openh264dec", "gstreamer1.0-plugins-bad"},
    {"rtspsrc", "gstreamer1.0-plugins-good"},   {"v4l2", "gstreamer1.0-plugins-good"},
    {"rtp", "gstreamer1.0-plugins-good"},       {"udpsrc", "gstreamer1.0-plugins-good"},
    {"jpeg", "gstreamer1.0-plugins-good"},      {"video", "gstreamer1.0-plugins-base"}};

/// What follows the :// of an address, without what may be a password: all before the @, and what is asked of
/// the server, which cheap cameras take as user=...&password=... of a path.
std::string publicAddress(std::string text) {
  constexpr const char* kQuestion = "?&=#;";
  const size_t owner = text.rfind('@');
  if (owner != std::string::npos && text.find_first_of(kQuestion) < owner)
    return "...";  // either may hold the other
  if (owner != std::string::npos) text.erase(0, owner + 1);
  const size_t question = text.find_first_of(kQuestion);
  if (question == std::string::npos) return text;
  const size_t segment = text[question] == '?' ? std::string::npos : text.rfind('/', question);
  return text.substr(0, segment == std::string::npos ? question : segment);
}

/// One line, without passwords.
std::string publicLine(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  for (size_t at = text.find("://"); at != std::string::npos; at = text.find("://", at)) {
    at += 3;
    const size_t end = std::min(text.find_first_of(" \"'", at), text.size());
    // Of a location: "rtsp://...: Could not".
    const size_t length = end - at - (end > at && text[end - 1] == ':' ? 1 : 0);
    text.replace(at, length, publicAddress(text.substr(at, length)));
  }
  return text;
}

std::string factoryOf(GstObject* object) {
  if (!GST_IS_ELEMENT(object)) return "";
  GstElementFactory* factory = gst_element_get_factory(GST_ELEMENT(object));
  return factory != nullptr ? GST_OBJECT_NAME(factory) : "";
}

/// The name without the number that GStreamer counts up with every element that it makes.
std::string nameOf(GstObject* object) {
  const std::string name = GST_OBJECT_NAME(object);
  const std::string factory = factoryOf(object);
  const bool is_counted = !factory.empty() && name.compare(0, factory.size(), factory) == 0 &&
                          name.find_first_not_of("0123456789", factory.size()) == std::string::npos;
  return is_counted ? factory : name;
}

std::string propertyOf(GstObject* object, const char* property) {
  const GParamSpec* found = g_object_class_find_property(G_OBJECT_GET_CLASS(object), property);
  if (found == nullptr || found->value_type != G_TYPE_STRING) return "";
  gchar* value = nullptr;
  g_object_get(object, property, &value, nullptr);
  std::string text = value != nullptr ? value : "";
  g_free(value);
  return text;
}

/// Of the element, or of the one that it is a part of; empty where none has one.
std::string placeOf(GstObject* object) {
  for (GstObject* at = object; at != nullptr; at = GST_OBJECT_PARENT(at)) {
    for (const char* property : {"location", "device", "uri"}) {
      if (std::string place = propertyOf(at, property); !place.empty()) return place;
    }
  }
  return "";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

void removeFrom(std::string& text, const std::string& part) {
  if (const size_t at = text.find(part); at != std::string::npos) text.erase(at, part.size());
}

}  // namespace

/// The last line of the details names the file or the device, or the reason.
std::string faultOf(GstMessage* message) {
  GError* raw_error = nullptr;
  gchar* details = nullptr;
  gst_message_parse_error(message, &raw_error, &details);
  const std::unique_ptr<GError, FreeError> error(raw_error);
  std::string text = error->message;
  const std::string all = details != nullptr ? details : "";
  g_free(details);
  if (const size_t line = all.rfind('\n'); line != std::string::npos) text += " " + all.substr(line + 1);
  // Of a file that is no device the error is whatever happened last.
  if (const size_t stray = text.find(" system error: ");
      contains(text, "isn't a device") && stray != std::string::npos)
    text.resize(stray);
  removeFrom(text, " (Generic error)");
  if (contains(text, "not-negotiated"))
    text += ": no format in common; the appsink takes JPEG, GRAY8, RGB, BGR: ... ! videoconvert ! appsink";
  std::string place = placeOf(message->src);
  if (!place.empty() && contains(text, place)) place.clear();
  return publicLine(nameOf(message->src) + (place.empty() ? "" : " " + place) + ": " + text);
}

std::string faultOf(const GError& error) {
  std::string text = error.message;
  if (g_error_matches(&error, GST_PARSE_ERROR, GST_PARSE_ERROR_NO_SUCH_ELEMENT) == FALSE)
    return publicLine(text);
  for (const ElementPackage& of : kPackages) {
    if (contains(text, std::string("\"") + of.name))
      return publicLine(text + ": apt-get install " + of.package);
  }
  return publicLine(text);
}

}  // namespace redbee
