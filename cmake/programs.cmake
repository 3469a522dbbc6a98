# Compute shaders: a/x.comp becomes SPIR-V in the header a/x.comp.h of the build folder, as the array kXSpirv.
find_program(GLSLANG_VALIDATOR glslangValidator REQUIRED)

function(relamp_add_programs target)
    set(folder ${CMAKE_CURRENT_BINARY_DIR}/programs)
    foreach(source ${ARGN})
        cmake_path(GET source STEM stem)
        cmake_path(GET source PARENT_PATH parent)
        string(REPLACE "_" ";" words ${stem})
        set(name k)
        foreach(word ${words})
            string(SUBSTRING ${word} 0 1 initial)
            string(TOUPPER ${initial} initial)
            string(SUBSTRING ${word} 1 -1 rest)
            string(APPEND name ${initial}${rest})
        endforeach()
        set(header ${folder}/${source}.h)
        file(MAKE_DIRECTORY ${folder}/${parent})
        add_custom_command(OUTPUT ${header}
            COMMAND ${GLSLANG_VALIDATOR} --quiet -V --target-env vulkan1.2 -I${CMAKE_CURRENT_SOURCE_DIR}
                    --depfile ${header}.d --vn ${name}Spirv -o ${header} ${CMAKE_CURRENT_SOURCE_DIR}/${source}
            DEPENDS ${source} DEPFILE ${header}.d
            COMMENT "Compiling ${source}" VERBATIM)
        target_sources(${target} PRIVATE ${header})
    endforeach()
    target_include_directories(${target} PRIVATE ${folder})
endfunction()
