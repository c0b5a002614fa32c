# Writes OUTPUT, a header with the version that this build is: the release, and the commit where there is a git checkout. Run at every
# build; the file changes only when the version does.
set(version ${VERSION})
find_program(GIT git)
if(GIT)
  execute_process(COMMAND ${GIT} -C ${SOURCE_DIR} describe --always --abbrev=10 --dirty=.changed --exclude=*
                  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
  if(NOT failed)
    string(APPEND version "+${commit}")
  endif()
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "#define REDBEE_RELEASE \"${VERSION}\"\n#define REDBEE_BUILD_VERSION \"${version}\"\n")
