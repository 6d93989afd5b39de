# The playground as static files, with rheonet as WebAssembly, in build/site. Without emscripten everything else builds.
# The module is optimised whatever the build of the programs: by default only the optimised one makes it.
string(COMPARE EQUAL "${CMAKE_BUILD_TYPE}" Release is_optimised)
option(RHEONET_SITE "Build the site: the playground that needs no server; needs emscripten" ${is_optimised})
set(RHEONET_SITE_DIR ${PROJECT_SOURCE_DIR}/build/site CACHE PATH "Where the site is put")
find_program(EMXX em++)
find_path(FAST_FLOAT_INCLUDE fast_float/fast_float.h)
if(RHEONET_SITE AND RHEONET_WEB AND NODE AND NPM)
  if(EMXX AND FAST_FLOAT_INCLUDE)
    set(site ${PROJECT_SOURCE_DIR}/tools/site)
    file(GLOB site_sources CONFIGURE_DEPENDS core/*/*.[ch]pp components/*.[ch]pp tools/plot/* tools/draw/* tools/report/* tools/rheonet/*.[ch]pp
      tools/serve/*.[ch]pp tools/site/* tools/web/* tools/web/src/* tools/web/src/*/*)
    file(GLOB_RECURSE site_netlists CONFIGURE_DEPENDS netlists/*.toml netlists/*.csv netlists/*.lesson netlists/README.md)
    add_executable(rheonet_unit_table EXCLUDE_FROM_ALL ${site}/unit_table.cpp)
    target_include_directories(rheonet_unit_table SYSTEM PRIVATE ${UDUNITS2_INCLUDE})
    target_link_libraries(rheonet_unit_table PRIVATE rheonet_warnings ${UDUNITS2_LIBRARY})
    add_custom_command(
      OUTPUT ${RHEONET_SITE_DIR}/rheonet.html
      COMMAND ${site}/build.sh ${CMAKE_BINARY_DIR}/tools/site ${CMAKE_BINARY_DIR}/tools/web ${RHEONET_SITE_DIR} ${PROJECT_VERSION}
        ${IDA_INCLUDE} "${CMAKE_CXX_COMPILER_LAUNCHER}" $<TARGET_FILE:rheonet_unit_table> $<TARGET_FILE:rheonet_program>
      DEPENDS ${site_sources} ${site_netlists}
      COMMENT "Building the site"
      VERBATIM)
    add_custom_target(rheonet_site ALL DEPENDS ${RHEONET_SITE_DIR}/rheonet.html)
    add_dependencies(rheonet_site rheonet_web rheonet_unit_table rheonet_program)
  else()
    message(STATUS "emscripten is missing (Debian: emscripten, libfast-float-dev): the site is not built")
  endif()
endif()
