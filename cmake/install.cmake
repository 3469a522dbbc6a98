# `cmake --install` gives bin/relamp, the library with its headers, what find_package(relamp) reads, and the Python
# module; `cpack` puts the module into the Debian package python3-relamp, and all else into relamp.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/relamp)
install(TARGETS relamp EXPORT relamp_targets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS relamp_formats LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS relamp_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS relamp_view RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY include/relamp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
install(EXPORT relamp_targets NAMESPACE relamp:: FILE relampTargets.cmake DESTINATION ${package_dir})
if(TARGET relamp_reference)
    set(reference ${PROJECT_BINARY_DIR}/reference)
    install(DIRECTORY ${reference}/man/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
    install(FILES ${reference}/relamp DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
    install(FILES ${reference}/_relamp DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions)
    install(FILES ${reference}/relamp.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
endif()
install(DIRECTORY workflow config DESTINATION ${CMAKE_INSTALL_DATADIR}/relamp PATTERN __pycache__ EXCLUDE)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright OPTIONAL)

configure_package_config_file(cmake/relampConfig.cmake.in relampConfig.cmake
    INSTALL_DESTINATION ${package_dir} NO_SET_AND_CHECK_MACRO NO_CHECK_REQUIRED_COMPONENTS_MACRO)
write_basic_package_version_file(relampConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/relampConfig.cmake ${PROJECT_BINARY_DIR}/relampConfigVersion.cmake
    DESTINATION ${package_dir})

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "relamp maintainers")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/src) # librelamp, which the module loads
# The headers name GLM's types. The program does not need it, and apt brings what is recommended unless told otherwise.
# libvulkan1 is looked for when a GPU is.
set(CPACK_DEBIAN_RELAMP_PACKAGE_RECOMMENDS "libglm-dev, libvulkan1")
set(CPACK_DEBIAN_RELAMP_PACKAGE_SUGGESTS "ffmpeg, snakemake") # for films as .mp4; for many scans
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)
set(CPACK_COMPONENTS_ALL relamp)
set(CPACK_DEBIAN_RELAMP_PACKAGE_NAME relamp)
if(TARGET relamp_python)
    list(APPEND CPACK_COMPONENTS_ALL python3)
    math(EXPR next_minor "${Python_VERSION_MINOR} + 1")
    set(CPACK_COMPONENT_PYTHON3_DEPENDS relamp)
    set(CPACK_DEBIAN_PYTHON3_PACKAGE_NAME python3-relamp)
    set(CPACK_DEBIAN_PYTHON3_PACKAGE_SECTION python)
    set(CPACK_DEBIAN_PYTHON3_DESCRIPTION "relamp for Python: the light taken out of a scanned room, as NumPy arrays")
    set(CPACK_DEBIAN_PYTHON3_PACKAGE_DEPENDS
        "python3 (>= 3.${Python_VERSION_MINOR}), python3 (<< 3.${next_minor}), python3-numpy")
endif()
include(CPack)
