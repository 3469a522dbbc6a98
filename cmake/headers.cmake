# A cold build spends most of its time on headers from outside. What most sources include is parsed once a target,
# and not once a source; and where even what those headers make takes longer than the sources themselves, all of a
# target's are compiled as one. ccache would keep nothing, or too little, that is built so: with it, every source is
# compiled by itself and must do with the headers that it names.
if(CMAKE_CXX_COMPILER_LAUNCHER)
    set(CMAKE_DISABLE_PRECOMPILE_HEADERS ON)
endif()

function(relamp_precompile target)
    target_precompile_headers(${target} PRIVATE <algorithm> <array> <cmath> <filesystem> <functional> <map> <memory>
        <optional> <random> <span> <string> <vector> <glm/glm.hpp> ${ARGN})
endfunction()

function(relamp_compile_as_one target)
    if(NOT CMAKE_CXX_COMPILER_LAUNCHER)
        set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 0)
    endif()
endfunction()
