# What "cmake --install" puts where. Two components, which become two packages: myotact, and myotact-prepare, whose
# licence differs. A program finds its data in share/myotact beside its own bin (src/core/data_folder.cpp).

include(GNUInstallDirs)
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)  # cpack would build every test, too
set(MYOTACT_RELEASE_DATE 2026-11-28)
set(MYOTACT_RELEASE_TIME "Sat, 28 Nov 2026 00:00:00 +0000")
set(MYOTACT_CONTACT authors@myotact.invalid)
set(packaging "${PROJECT_SOURCE_DIR}/tools/packaging")
set(made "${PROJECT_BINARY_DIR}/install")

# Programs in the build folder find the sources where installed ones find their data.
file(MAKE_DIRECTORY "${PROJECT_BINARY_DIR}/share")
file(CREATE_LINK "${PROJECT_SOURCE_DIR}" "${PROJECT_BINARY_DIR}/share/myotact" SYMBOLIC)

# myotact_install_program(TARGET): the program, its manual page made from its --help, its licences and history.
function(myotact_install_program program)
  configure_file("${packaging}/changelog.in" "${made}/${program}/changelog" @ONLY)
  add_custom_command(OUTPUT "${made}/${program}.1.gz" "${made}/${program}/changelog.gz"
    COMMAND "${packaging}/make_man_page.sh" "$<TARGET_FILE:${program}>" ${PROJECT_VERSION} ${MYOTACT_RELEASE_DATE}
            > "${made}/${program}.1"
    COMMAND gzip -9nf "${made}/${program}.1"
    COMMAND gzip -9nfk "${made}/${program}/changelog"
    DEPENDS ${program} "${packaging}/make_man_page.sh" "${packaging}/help_to_man.awk" "${made}/${program}/changelog"
    VERBATIM)
  add_custom_target(${program}-manual ALL DEPENDS "${made}/${program}.1.gz")
  install(TARGETS ${program} RUNTIME COMPONENT ${program})
  install(FILES "${made}/${program}.1.gz" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1" COMPONENT ${program})
  install(FILES "${packaging}/copyright.${program}" DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/${program}"
    RENAME copyright COMPONENT ${program})
  install(FILES "${made}/${program}/changelog.gz" DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/${program}"
    COMPONENT ${program})
endfunction()

myotact_install_program(myotact)
if(MYOTACT_BUILD_PREPARE)
  myotact_install_program(myotact-prepare)
endif()

set(data "${CMAKE_INSTALL_DATADIR}/myotact")
install(DIRECTORY assets meshes shaders DESTINATION "${data}" COMPONENT myotact
  PATTERN assets/desktop EXCLUDE)
# Built by tools/build_web.sh before; without it `serve --web` tells what is missing.
install(DIRECTORY web/dist DESTINATION "${data}/web" COMPONENT myotact OPTIONAL)
# Where the system looks for what packages bring.
install(FILES assets/devices/udev/70-myotact.rules DESTINATION lib/udev/rules.d COMPONENT myotact)
install(DIRECTORY tests/validation DESTINATION "${data}/tests" COMPONENT myotact FILES_MATCHING PATTERN *.json)
install(FILES README.md CHANGELOG.md CITATION.cff DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/myotact" COMPONENT myotact)
install(DIRECTORY docs DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/myotact" COMPONENT myotact FILES_MATCHING PATTERN *.md
  PATTERN pictures EXCLUDE)
# Debian has this text in a place of its own, so that its packages leave this component out.
install(FILES LICENSE DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/myotact" COMPONENT licence)

set(desktop "${PROJECT_SOURCE_DIR}/assets/desktop")
configure_file("${desktop}/myotact.metainfo.xml.in" "${made}/myotact.metainfo.xml" @ONLY)
install(FILES "${made}/myotact.metainfo.xml" DESTINATION "${CMAKE_INSTALL_DATADIR}/metainfo" COMPONENT myotact)
install(FILES "${desktop}/myotact.desktop" DESTINATION "${CMAKE_INSTALL_DATADIR}/applications" COMPONENT myotact)
set(icons "${CMAKE_INSTALL_DATADIR}/icons/hicolor")
install(FILES "${desktop}/myotact.svg" DESTINATION "${icons}/scalable/apps" COMPONENT myotact)
foreach(size 48 128 256)
  install(FILES "${desktop}/myotact-${size}.png" DESTINATION "${icons}/${size}x${size}/apps" RENAME myotact.png
    COMPONENT myotact)
endforeach()
