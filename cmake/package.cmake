# The Debian package (script/package). Programs and modules are installed by their rooms; what follows is installed beside them.
include(GNUInstallDirs)
set(PARVIS_PACKAGE_TEXTS ${CMAKE_BINARY_DIR}/package)  # written by script/package
install(DIRECTORY scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/parvis)
install(FILES packaging/parvis.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications)
install(FILES packaging/parvis.svg DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps)
install(FILES packaging/copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/parvis)
install(FILES ${PARVIS_PACKAGE_TEXTS}/parvis.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 OPTIONAL)
install(FILES ${PARVIS_PACKAGE_TEXTS}/parvis DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions OPTIONAL)

# What is packed is what was built: tests and benches need not be.
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME parvis)
set(CPACK_PACKAGE_CONTACT "The authors of Parvis <parvis@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION "
 Parvis shows places as they are and as they are planned to be: with daylight of any hour, reflections, plants,
 traffic, people and sound. Architects place objects in them, measure, compare designs and share them as a folder
 that any browser opens.")
# Libraries are found out by dpkg-shlibdeps; OpenGL's drivers and fonts are loaded while the program runs, programs are started by it.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PARVIS_MODULE_FOLDER})
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libgl1-mesa-dri, libegl1, libgl1, fonts-inter | fonts-dejavu-core, tzdata")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS ffmpeg)
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "colmap, gimp, openmpi-bin")
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA ${CMAKE_SOURCE_DIR}/packaging/preinst)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
include(CPack)
