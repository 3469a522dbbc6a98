# A cold build spends most of its time on headers from outside: on parsing them, and on making anew in every source what
# their templates come to. So the sources of a folder are compiled as one unit, and what most of them include is parsed
# once a target. Both cost whoever works on one file: the preset dev, and ccache, which would keep nothing that is built
# so, compile every source by itself, and it must do with the headers that it names.
option(RELAMP_UNITY "Compile the sources of a folder as one" ON)
if(CMAKE_CXX_COMPILER_LAUNCHER)
    set(CMAKE_DISABLE_PRECOMPILE_HEADERS ON)
    set(RELAMP_UNITY OFF)
endif()

# The sources of one folder must not give two things one name. What follows `target` are headers to precompile.
function(relamp_compile_by_folder target)
    get_target_property(sources ${target} SOURCES)
    set(folders "")
    foreach(source ${sources})
        cmake_path(GET source PARENT_PATH folder)
        string(REPLACE ${PROJECT_SOURCE_DIR}/ "" folder "${folder}")
        string(MAKE_C_IDENTIFIER "in_${folder}" group)
        set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group})
        list(APPEND folders ${group})
    endforeach()
    list(REMOVE_DUPLICATES folders)
    list(LENGTH folders units)
    if(RELAMP_UNITY)
        set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
        target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>) # takes every source for a header
    endif()
    if(NOT RELAMP_UNITY OR units GREATER 4) # of fewer, parsing headers twice takes longer
        target_precompile_headers(${target} PRIVATE <algorithm> <array> <cmath> <filesystem> <functional> <map> <memory>
            <optional> <random> <span> <string> <vector> <glm/glm.hpp> ${ARGN})
    endif()
endfunction()
