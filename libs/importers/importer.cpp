#include "redbee/importers/importer.hpp"

#include "redbee/importers/import_asl.hpp"
#include "redbee/importers/import_gopro.hpp"
#include "redbee/importers/import_video.hpp"

namespace redbee {

const std::vector<Importer>& importers() {
  static const std::vector<Importer> all{aslImporter(), videoImporter(), goproImporter()};
  return all;
}

}  // namespace redbee
