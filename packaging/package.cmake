# What `cmake --install` installs and how CPack makes a Debian package of it. packaging/package runs all of it.
include(GNUInstallDirs)
find_program(GZIP_PROGRAM gzip)
find_program(RSVG_CONVERT rsvg-convert)

set(CPACK_PACKAGE_NAME atrium)
set(CPACK_PACKAGE_VENDOR "The Atrium developers")
set(ATRIUM_PACKAGE_CONTACT "The Atrium developers <atrium@example.org>" CACHE STRING
    "Name and address of whoever publishes the package")
set(CPACK_PACKAGE_CONTACT "${ATRIUM_PACKAGE_CONTACT}")
set(packaging ${CMAKE_CURRENT_LIST_DIR})
set(made ${CMAKE_BINARY_DIR}/packaging)
file(MAKE_DIRECTORY ${made})

# Dates in the package are the commit's, so that the same commit gives the same bytes.
set(ATRIUM_RELEASE_EPOCH "$ENV{SOURCE_DATE_EPOCH}")
if(ATRIUM_RELEASE_EPOCH STREQUAL "")
  execute_process(COMMAND git -C ${CMAKE_SOURCE_DIR} log -1 --format=%ct OUTPUT_VARIABLE ATRIUM_RELEASE_EPOCH
                  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
if(ATRIUM_RELEASE_EPOCH STREQUAL "")
  set(ATRIUM_RELEASE_EPOCH 0)
endif()
foreach(pair "ATRIUM_RELEASE_DAY;+%Y-%m-%d" "ATRIUM_RELEASE_TIME;+%a, %d %b %Y %H:%M:%S +0000")
  list(GET pair 0 variable)
  list(GET pair 1 form)
  execute_process(COMMAND ${CMAKE_COMMAND} -E env LC_ALL=C TZ=UTC date -d @${ATRIUM_RELEASE_EPOCH} ${form}
                  OUTPUT_VARIABLE ${variable} OUTPUT_STRIP_TRAILING_WHITESPACE)
endforeach()
execute_process(COMMAND git -C ${CMAKE_SOURCE_DIR} rev-parse --short=12 HEAD OUTPUT_VARIABLE commit
                OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
set(ATRIUM_COMMIT_NOTE "")
if(commit)
  set(ATRIUM_COMMIT_NOTE ", commit ${commit}")
endif()
configure_file(${packaging}/desktop/atrium.metainfo.xml.in ${made}/atrium.metainfo.xml @ONLY)
configure_file(${packaging}/debian/changelog.in ${made}/changelog @ONLY)

# Manual pages and completions come from the programs' own option tables.
set(documents)
foreach(program atrium atrium-cli)
  if(TARGET ${program})
    add_custom_command(OUTPUT ${made}/${program}.1 ${made}/${program}.bash
      COMMAND ${program} --write-manual-page > ${made}/${program}.1
      COMMAND ${program} --write-completion > ${made}/${program}.bash
      DEPENDS ${program} COMMENT "Manual page and completion of ${program}" VERBATIM)
    list(APPEND documents ${made}/${program}.1 ${made}/${program}.bash)
    install(FILES ${made}/${program}.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME ${program})
    if(GZIP_PROGRAM)
      add_custom_command(OUTPUT ${made}/${program}.1.gz COMMAND ${GZIP_PROGRAM} -9nc ${made}/${program}.1 > ${made}/${program}.1.gz
                         DEPENDS ${made}/${program}.1 VERBATIM)
      list(APPEND documents ${made}/${program}.1.gz)
      install(FILES ${made}/${program}.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
    else()
      install(FILES ${made}/${program}.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
    endif()
  endif()
endforeach()

# What people read.
if(GZIP_PROGRAM)
  foreach(pair "${CMAKE_SOURCE_DIR}/CHANGELOG.md;changelog.gz" "${made}/changelog;changelog.Debian.gz")
    list(GET pair 0 source)
    list(GET pair 1 name)
    add_custom_command(OUTPUT ${made}/${name} COMMAND ${GZIP_PROGRAM} -9nc ${source} > ${made}/${name} DEPENDS ${source} VERBATIM)
    list(APPEND documents ${made}/${name})
    install(FILES ${made}/${name} DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/atrium)
  endforeach()
endif()
install(FILES ${packaging}/debian/copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/atrium)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/resources/manual DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/atrium)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/atrium
        PATTERN "*.py" EXCLUDE PATTERN "__pycache__" EXCLUDE PATTERN "hard" EXCLUDE)

# What desktops read.
if(TARGET atrium)
  install(FILES ${packaging}/desktop/atrium.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications)
  install(FILES ${packaging}/desktop/atrium-mime.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/mime/packages RENAME atrium.xml)
  install(FILES ${made}/atrium.metainfo.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/metainfo)
  install(FILES ${CMAKE_SOURCE_DIR}/resources/atrium.svg DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps)
  if(RSVG_CONVERT)
    foreach(size 16 32 48 64 128 256)
      set(icon ${made}/icon-${size}.png)
      add_custom_command(OUTPUT ${icon} COMMAND ${RSVG_CONVERT} -w ${size} -h ${size} ${CMAKE_SOURCE_DIR}/resources/atrium.svg -o ${icon}
                         DEPENDS ${CMAKE_SOURCE_DIR}/resources/atrium.svg VERBATIM)
      list(APPEND documents ${icon})
      install(FILES ${icon} DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/${size}x${size}/apps RENAME atrium.png)
    endforeach()
  endif()
endif()
add_custom_target(documents ALL DEPENDS ${documents})

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "editor of interiors with live global illumination")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
"Architects and lighting designers move furniture, dim lamps or paint walls
and see the light of the whole room follow, in photometric units. Scenes are
glTF 2.0; projects keep their light. Sun, sky, lamps, mirrors, polished metal
and glass are simulated, caustics included.
.
The package has the editor, atrium, and atrium-cli, which solves, measures,
draws and checks scenes without a display.")
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "libgl1-mesa-dri, qt6-translations-l10n")
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
include(CPack)
