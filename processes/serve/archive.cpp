#include "processes/serve/archive.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <map>
#include <regex>
#include <set>
#include <tuple>
#include <utility>

#include "redbee/files/natural_order.hpp"
#include "redbee/files/printable.hpp"

namespace redbee {
namespace {

namespace fs = std::filesystem;
constexpr size_t kMostOpened = 3;
constexpr std::chrono::seconds kListKept{2};
constexpr int kDeepest = 3;           ///< folders below a given one
constexpr size_t kMostFiles = 20000;  ///< looked at

/// The name of the log that a part belongs to; empty for another file.
std::string logOf(const std::string& name) {
  static const std::regex pattern(R"((.*\.lcm)(\.[0-9]+)?)");
  std::smatch match;
  return std::regex_match(name, match, pattern) ? match[1].str() : "";
}

void newestFirst(std::vector<Archive::Entry>& entries) {
  std::sort(entries.begin(), entries.end(), [](const Archive::Entry& a, const Archive::Entry& b) {
    return std::tie(b.modified_s, a.name) < std::tie(a.modified_s, b.name);
  });
}

/// `paths`: of the entries, in their order.
void makeNamesUnique(std::vector<Archive::Entry>& entries, const std::vector<std::string>& paths) {
  std::map<std::string, int> uses;
  for (const Archive::Entry& entry : entries) ++uses[entry.name];
  for (size_t i = 0; i < entries.size(); ++i) {
    if (uses[entries[i].name] > 1) entries[i].name = paths[i];
  }
}

}  // namespace

Archive::Archive(const Configuration& configuration, std::vector<fs::path> folders)
    : configuration_(configuration), folders_(std::move(folders)) {}

std::optional<std::vector<Archive::Entry>> Archive::filesSince(Clock::time_point oldest) const {
  const std::lock_guard<std::mutex> lock(files_mutex_);
  if (files_.empty() || files_read_ < oldest) return std::nullopt;
  return files_;
}

std::vector<Archive::Entry> Archive::files() const {
  if (auto kept = filesSince(Clock::now() - kListKept)) return *std::move(kept);
  std::unique_lock<std::mutex> reading(reading_mutex_, std::try_to_lock);
  if (!reading) {
    // Somebody else is reading them, on a disk that may be slow: what was there is better than to wait.
    if (auto kept = filesSince(Clock::time_point())) return *std::move(kept);
    reading.lock();
    if (auto kept = filesSince(Clock::now() - kListKept)) return *std::move(kept);
  }
  std::vector<Entry> found = readFolders();
  const std::lock_guard<std::mutex> lock(files_mutex_);
  files_ = found;
  files_read_ = Clock::now();
  return found;
}

std::vector<Archive::Entry> Archive::readFolders() const {
  std::vector<Entry> entries;
  std::set<fs::path> known;  // one folder may be given twice, or lie in another
  for (const fs::path& given : folders_) {
    std::error_code error;
    const fs::path folder = fs::canonical(given, error);
    if (error) continue;  // that of recordings, before the first one
    auto at = fs::recursive_directory_iterator(folder, fs::directory_options::skip_permission_denied, error);
    for (; !error && at != fs::recursive_directory_iterator() && entries.size() < kMostFiles;
         at.increment(error)) {
      if (at.depth() >= kDeepest) at.disable_recursion_pending();
      if (at->path().extension() == ".png") continue;  // the maps of a run
      struct stat status {};
      // A link may lead out of the folder.
      if (lstat(at->path().c_str(), &status) != 0 || !S_ISREG(status.st_mode)) continue;
      if (!known.insert(at->path()).second) continue;
      entries.push_back({printable(at->path().lexically_relative(folder.parent_path()).string()),
                         status.st_size,
                         status.st_mtime,
                         {at->path()}});
    }
  }
  newestFirst(entries);
  return entries;
}

std::vector<Archive::Entry> Archive::flights() const {
  std::map<std::string, Entry> logs;
  for (const Entry& file : files()) {
    const std::string path = logOf(file.files.front().string());
    if (path.empty()) continue;
    Entry& entry = logs[path];
    entry.name = logOf(file.name);
    entry.bytes += file.bytes;
    entry.modified_s = std::max(entry.modified_s, file.modified_s);
    entry.files.push_back(file.files.front());
  }
  std::vector<Entry> result;
  std::vector<std::string> paths;
  for (auto& [path, entry] : logs) {
    std::sort(entry.files.begin(), entry.files.end(), isFileNaturallyBefore);
    paths.push_back(printable(path));
    result.push_back(std::move(entry));
  }
  makeNamesUnique(result, paths);
  newestFirst(result);
  return result;
}

std::vector<Archive::Entry> Archive::reports() const {
  std::vector<Entry> result;
  std::vector<std::string> paths;
  for (Entry& file : files()) {
    if (fs::path(file.name).extension() != ".html") continue;
    paths.push_back(printable(file.files.front().string()));
    result.push_back(std::move(file));
  }
  makeNamesUnique(result, paths);
  return result;
}

std::shared_ptr<const Flight> Archive::open(const std::string& name, bool refresh) {
  Reading reading;
  if (!refresh) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto kept =
        std::find_if(opened_.begin(), opened_.end(), [&](const Opened& o) { return o.name == name; });
    if (kept != opened_.end()) reading = kept->flight;
  }
  if (!reading) {
    const auto entries = flights();
    const auto entry =
        std::find_if(entries.begin(), entries.end(), [&](const Entry& e) { return e.name == name; });
    if (entry == entries.end()) return nullptr;
    reading = readingOf(*entry);
  }
  try {
    return reading->get();
  } catch (...) {
    forget(reading);
    throw;
  }
}

Archive::Reading Archive::readingOf(const Entry& entry) {
  std::vector<fs::path> runs;
  for (const Entry& file : files()) {
    if (file.files.front().filename() == "homography.csv") runs.push_back(file.files.front().parent_path());
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto kept = std::find_if(opened_.begin(), opened_.end(), [&](const Opened& o) {
    return o.name == entry.name && o.bytes == entry.bytes;
  });
  if (kept != opened_.end()) {
    opened_.splice(opened_.begin(), opened_, kept);
    return opened_.front().flight;
  }
  opened_.remove_if([&](const Opened& o) { return o.name == entry.name; });
  // Read by the first who asks for it, without the lock: a log may take seconds.
  auto read = std::async(std::launch::deferred, [this, files = entry.files, runs] {
    return std::make_shared<const Flight>(configuration_, files, runs);
  });
  opened_.push_front({entry.name, entry.bytes,
                      std::make_shared<std::shared_future<std::shared_ptr<const Flight>>>(read.share())});
  if (opened_.size() > kMostOpened) opened_.pop_back();
  return opened_.front().flight;
}

void Archive::forget(const Reading& reading) {
  const std::lock_guard<std::mutex> lock(mutex_);
  opened_.remove_if([&](const Opened& o) { return o.flight == reading; });
}

std::optional<Archive::Entry> Archive::report(const std::string& name) const {
  for (Entry& entry : reports()) {
    if (entry.name == name) return std::move(entry);
  }
  return std::nullopt;
}

}  // namespace redbee
