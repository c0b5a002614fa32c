#include "processes/redbee/pages/svg_plot.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "processes/redbee/pages/file_content.hpp"
#include "processes/redbee/pages/number.hpp"
#include "redbee/files/input_error.hpp"

namespace redbee {
namespace {

namespace fs = std::filesystem;

/// A temporary folder for gnuplot's input and output.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = (fs::temp_directory_path() / "redbee-plot-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error(name + ": cannot be created");
    path_ = name;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c == '\n' ? ' ' : c);
  return result + "'";
}

std::string number(double value) { return significant(value, 7); }

/// The drawing without XML declarations, which have no place within a page.
std::string withoutDeclarations(const std::string& svg) {
  const size_t start = svg.find("<svg");
  return start == std::string::npos ? svg : svg.substr(start);
}

}  // namespace

SvgPlot::SvgPlot(std::string title, std::string x_label, std::string y_label)
    : title_(std::move(title)), x_label_(std::move(x_label)), y_label_(std::move(y_label)) {}

void SvgPlot::addLine(const std::string& name, const std::vector<double>& x, const std::vector<double>& y,
                      const std::string& colour) {
  Series series{name, {}, colour, true};
  for (size_t i = 0; i < std::min(x.size(), y.size()); ++i) series.points.emplace_back(x[i], y[i]);
  series_.push_back(std::move(series));
}

void SvgPlot::addPoints(const std::string& name, const std::vector<Eigen::Vector2d>& points,
                        const std::string& colour) {
  series_.push_back({name, points, colour, false});
}

void SvgPlot::addMark(const std::string& name, double x) { marks_.emplace_back(name, x); }

void SvgPlot::makeSquare(double low, double high) {
  low_ = low;
  high_ = high;
}

bool SvgPlot::isDrawable(const Series& series) {
  return std::any_of(series.points.begin(), series.points.end(),
                     [](const Eigen::Vector2d& point) { return point.allFinite(); });
}

std::string SvgPlot::settings() const {
  const bool square = low_ < high_;
  std::ostringstream out;
  out << "set terminal svg noenhanced size " << (square ? "480,480" : "620,260")
      << " font 'sans-serif,12' background '#ffffff'\n"
      << "set title " << quoted(title_) << "\nset xlabel " << quoted(x_label_) << "\nset ylabel "
      << quoted(y_label_) << "\nset key below horizontal height 1\nset grid lc rgb '#dddddd'\n";
  std::string range = "[0:1]";  // of an empty plot
  if (square) {
    range = "[" + number(low_) + ":" + number(high_) + "]";
  } else if (std::any_of(series_.begin(), series_.end(), isDrawable)) {
    range = "[*:*]";
  }
  out << "set xrange " << range << "\nset yrange " << range << (square ? "\nset size square\n" : "\n");
  for (const auto& [name, x] : marks_) {
    out << "set arrow from first " << number(x) << ", graph 0 to first " << number(x)
        << ", graph 1 nohead dashtype 2 lc rgb '#555555'\nset label " << quoted(name) << " at first "
        << number(x) << ", graph 0.95 offset 0.5,0 tc rgb '#555555'\n";
  }
  return out.str();
}

std::string SvgPlot::curves() const {
  std::ostringstream data;
  std::string command = "plot NaN notitle";
  for (size_t i = 0; i < series_.size(); ++i) {
    const Series& series = series_[i];
    if (!isDrawable(series)) continue;
    const std::string block = "$series" + std::to_string(i);
    data << block << " << END\n";
    for (const Eigen::Vector2d& point : series.points) {
      if (point.allFinite()) data << number(point.x()) << ' ' << number(point.y());
      data << '\n';  // an empty line breaks the curve
    }
    data << "END\n";
    command += ", " + block + " with " + (series.line ? "lines lw 1.3" : "points pt 7 ps 0.15") + " lc rgb " +
               quoted(series.colour) + (series.name.empty() ? " notitle" : " title " + quoted(series.name));
  }
  return data.str() + command + "\n";
}

void SvgPlot::checkInstalled() {
  const int status =
      std::system("command -v gnuplot >/dev/null");  // NOLINT(concurrency-mt-unsafe): one thread
  if (status != 0) {
    throw InputError("gnuplot, which draws the plots, is not installed: apt-get install gnuplot-nox");
  }
}

std::string SvgPlot::svg() const {
  const ScratchFolder scratch;
  const fs::path input = scratch.path() / "plot.gp", output = scratch.path() / "plot.svg",
                 complaints = scratch.path() / "complaints";
  std::ofstream(input) << settings() << curves();
  const std::string command =
      "LC_ALL=C gnuplot '" + input.string() + "' >'" + output.string() + "' 2>'" + complaints.string() + "'";
  const int status = std::system(command.c_str());  // NOLINT(concurrency-mt-unsafe): one thread draws
  if (status != 0) throw std::runtime_error("gnuplot failed: " + contentOf(complaints).substr(0, 200));
  return withoutDeclarations(contentOf(output));
}

}  // namespace redbee
