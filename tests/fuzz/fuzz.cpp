// relamp_fuzz TARGET [OPTION OF LIBFUZZER ...] [CORPUS ...]

#include "fuzz/targets.h"
#include "relamp/threads.h"

#include <cstdio>
#include <map>

namespace
{

using namespace relamp::fuzz;

struct Way
{
    Target run;
    Mutator mutate = nullptr; // none: libFuzzer's own
};

const std::map<std::string_view, Way> kTargets{
    {"gltf", {readGltfFile, mutateGltf}},    {"obj", {readObjFile}},
    {"delight", {delightObjFile}},           {"ply", {readPlyFile}},
    {"image", {readPicture, mutatePicture}}, {"lights_json", {readLightsFile}},
    {"timeline_json", {readTimelineFile}},   {"ies", {readIesFile}},
    {"result", {useResult, mutateResult}}};

Way chosen;

} // namespace

const std::filesystem::path& relamp::fuzz::folder()
{
    static const std::filesystem::path path = [] {
        std::string pattern = "/dev/shm/relamp-fuzz-XXXXXX";
        if (mkdtemp(pattern.data()) == nullptr) std::abort();
        std::atexit([] {
            std::error_code ignored;
            std::filesystem::remove_all(folder(), ignored);
        });
        return std::filesystem::path(pattern);
    }();
    return path;
}

/// Takes the target's name out of the arguments; libFuzzer gets the rest.
extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv)
{
    const auto target = kTargets.find(*argc > 1 ? (*argv)[1] : "");
    if (target == kTargets.end()) {
        std::fputs("usage: relamp_fuzz TARGET [OPTION ...] [CORPUS ...], where TARGET is one of",
                   stderr);
        for (const auto& [name, way] : kTargets) std::fprintf(stderr, " %s", name.data());
        std::fputs("\n", stderr);
        std::exit(2);
    }
    chosen = target->second;
    static const relamp::ThreadLimit one(1); // inputs are small; more would wait for each other
    (*argv)[1] = (*argv)[0];
    ++*argv;
    --*argc;
    return 0;
}

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t most, unsigned seed)
{
    return chosen.mutate ? chosen.mutate(data, size, most, seed)
                         : LLVMFuzzerMutate(data, size, most);
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    chosen.run({data, size});
    return 0;
}
