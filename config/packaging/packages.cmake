# What cpack makes of a build (scripts/package): a Debian package for each component but "development". Shared libraries become dependencies
# by dpkg-shlibdeps; what else a package needs at run time stands here. `redbee` is all that a vehicle needs; what needs libraries of its own
# (GStreamer, an HTTP server, ROS, Ceres, Java) is a package of its own, which the build makes where it found them.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME redbee)
set(CPACK_PACKAGE_CONTACT "the REDBEE founders <founders@redbee.invalid>")
set(CPACK_PACKAGE_DIRECTORY ${CMAKE_BINARY_DIR}/packages)
set(CPACK_STRIP_FILES ON)
# With DESTDIR, so that the unit names the folder in which the programs will lie.
set(CPACK_SET_DESTDIR ON)
set(CPACK_INSTALL_PREFIX /usr)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL)

# redbee_package(COMPONENT NAME DESCRIPTION DEPENDS RECOMMENDS): the last two as in a control file.
macro(redbee_package component name description depends recommends)
  string(TOUPPER ${component} upper)
  list(APPEND CPACK_COMPONENTS_ALL ${component})
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name})
  set(CPACK_COMPONENT_${upper}_DESCRIPTION "${description}")
  set(CPACK_DEBIAN_${upper}_PACKAGE_DEPENDS "${depends}")
  set(CPACK_DEBIAN_${upper}_PACKAGE_RECOMMENDS "${recommends}")
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION share/doc/${name} RENAME copyright COMPONENT ${component})
endmacro()

set(same_release "redbee (= ${PROJECT_VERSION})")
redbee_package(runtime redbee "The stack's processes, drivers of an autopilot and of a ground link, the tool redbee, and the systemd unit."
  "supervisor, iproute2, util-linux, systemd | systemd-standalone-sysusers" "liblcm-bin, gnuplot-nox, nftables")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/config/packaging/postinst ${PROJECT_SOURCE_DIR}/config/packaging/prerm)
redbee_package(calibration redbee-calibrate "Calibration of REDBEE's camera and IMU from a flight." "${same_release}" "")
if(GSTREAMER_FOUND)
  redbee_package(camera redbee-camera "Camera driver of REDBEE: any GStreamer pipeline."
    "${same_release}, gstreamer1.0-plugins-base" "gstreamer1.0-plugins-good")
endif()
if(HTTPLIB_FOUND)
  redbee_package(serve redbee-serve "Ground station of REDBEE in the browser." "${same_release}" "")
endif()
if(TARGET rosbag_storage)
  redbee_package(rosbag redbee-rosbag "Import of ROS bags into REDBEE." "${same_release}" "")
endif()
if(TARGET redbee_spy)
  redbee_package(spy redbee-spy "REDBEE's message types and images in lcm-spy." "${same_release}, default-jre, liblcm-java, libjchart2d-java" "")
  set(CPACK_DEBIAN_SPY_PACKAGE_ARCHITECTURE all)
endif()
include(CPack)
