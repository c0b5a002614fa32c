#include "processes/redbee/mosaic/geotiff_file.hpp"

#include <geotiff/geotiff.h>
#include <geotiff/geovalues.h>
#include <geotiff/xtiffio.h>
#include <tiffio.h>

#include <array>
#include <memory>
#include <opencv2/imgproc.hpp>

#include "redbee/files/input_error.hpp"
#include "redbee/files/new_file.hpp"

namespace redbee {
namespace {

constexpr int kChannels = 4;

struct Close {
  void operator()(TIFF* tiff) const { XTIFFClose(tiff); }
  void operator()(GTIF* keys) const { GTIFFree(keys); }
};

/// From the raster, where (0, 0) is the corner of the first pixel, to the projected grid; row by row.
std::array<double, 16> transformation(const MosaicGrid& grid, const Georeference& reference) {
  constexpr double kCentre = 0.5;
  const Eigen::Matrix2d A = grid.units_per_px * reference.turn_and_scale;
  const Eigen::Vector2d corner = reference.placeOf(grid.origin) - A * Eigen::Vector2d(kCentre, kCentre);
  return {A(0, 0), A(0, 1), 0, corner.x(), A(1, 0), A(1, 1), 0, corner.y(), 0, 0, 0, 0, 0, 0, 0, 1};
}

void describe(TIFF* tiff, cv::Size size) {
  const std::array<uint16_t, 1> extra{EXTRASAMPLE_UNASSALPHA};
  TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, static_cast<uint32_t>(size.width));
  TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, static_cast<uint32_t>(size.height));
  TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, 8);
  TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, kChannels);
  TIFFSetField(tiff, TIFFTAG_EXTRASAMPLES, static_cast<uint16_t>(extra.size()), extra.data());
  TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_RGB);
  TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
  TIFFSetField(tiff, TIFFTAG_COMPRESSION, COMPRESSION_ADOBE_DEFLATE);
  TIFFSetField(tiff, TIFFTAG_PREDICTOR, PREDICTOR_HORIZONTAL);
  TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, TIFFDefaultStripSize(tiff, 0));
}

bool writeKeys(TIFF* tiff, int epsg) {
  const std::unique_ptr<GTIF, Close> keys(GTIFNew(tiff));
  if (!keys) return false;
  GTIFKeySet(keys.get(), GTModelTypeGeoKey, TYPE_SHORT, 1, ModelTypeProjected);
  GTIFKeySet(keys.get(), GTRasterTypeGeoKey, TYPE_SHORT, 1, RasterPixelIsArea);
  GTIFKeySet(keys.get(), ProjectedCSTypeGeoKey, TYPE_SHORT, 1, epsg);
  return GTIFWriteKeys(keys.get()) != 0;
}

}  // namespace

void writeGeoTiff(const std::filesystem::path& file, const cv::Mat4b& image, const MosaicGrid& grid,
                  const Georeference& reference, int epsg) {
  PartialFile partial(file);
  const std::unique_ptr<TIFF, Close> tiff(XTIFFOpen(partial.descriptorPath().c_str(), "w"));
  bool is_written = tiff != nullptr;
  if (is_written) {
    describe(tiff.get(), image.size());
    const auto matrix = transformation(grid, reference);
    TIFFSetField(tiff.get(), TIFFTAG_GEOTRANSMATRIX, static_cast<int>(matrix.size()), matrix.data());
    is_written = writeKeys(tiff.get(), epsg);
  }
  cv::Mat4b row;
  for (int y = 0; y < image.rows && is_written; ++y) {
    cv::cvtColor(image.row(y), row, cv::COLOR_BGRA2RGBA);
    is_written = TIFFWriteScanline(tiff.get(), row.data, static_cast<uint32_t>(y)) == 1;
  }
  if (!is_written || TIFFFlush(tiff.get()) == 0) throw InputError(file, "cannot be written");
  partial.commit();
}

}  // namespace redbee
