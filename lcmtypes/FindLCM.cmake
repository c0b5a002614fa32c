# lcm::lcm, for this build and for the installed package: liblcm-dev 1.3.1 ships no CMake package, and its .pc file asks for glib's, which
# it does not bring.
find_path(LCM_INCLUDE_DIR lcm/lcm-cpp.hpp)
find_library(LCM_LIBRARY lcm)
mark_as_advanced(LCM_INCLUDE_DIR LCM_LIBRARY)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(LCM REQUIRED_VARS LCM_LIBRARY LCM_INCLUDE_DIR)
if(LCM_FOUND AND NOT TARGET lcm::lcm)
  add_library(lcm::lcm INTERFACE IMPORTED)
  set_target_properties(lcm::lcm PROPERTIES INTERFACE_SYSTEM_INCLUDE_DIRECTORIES ${LCM_INCLUDE_DIR}
                                            INTERFACE_LINK_LIBRARIES ${LCM_LIBRARY})
endif()
