// tinygltf's own code. Debian's shared library of it was built with another layout of the class
// TinyGLTF than the header that comes with it (SetFsCallbacks overwrites a string), so the one
// header is compiled here. Pictures are read in src/image, hence no stb.

#include <nlohmann/json.hpp>

#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_INCLUDE_JSON
#include <tiny_gltf.h>
