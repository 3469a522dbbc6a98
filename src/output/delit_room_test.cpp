#include "relamp/relight.h"

#include "scenes/gltf_files.h"
#include "scenes/temporary_folder.h"

#include <gtest/gtest.h>

namespace relamp
{

// The first row of its texture is red and green, the second blue and white.
TEST(DelitRoom, BaseColourOfAPlainFileIsTextureTimesFactor)
{
    const scenes::TemporaryFolder folder;
    scenes::GltfFile file = scenes::texturedSquare();
    Progress progress;
    const auto albedoOf = [&](const std::string& name) {
        folder.write(name, file.glb());
        return readDelitRoom(folder / name, {}, progress).albedo.at(0);
    };
    const Image plain = albedoOf("plain.glb");
    file.material()["pbrMetallicRoughness"]["baseColorFactor"] = {0.5, 0.25, 1, 1};
    const Image tinted = albedoOf("tinted.glb");
    for (size_t pixel = 0; pixel < 4; ++pixel) {
        const glm::vec3 expected = Radiance(plain)[pixel] * glm::vec3(0.5f, 0.25f, 1.0f);
        EXPECT_EQ(Radiance(tinted)[pixel], expected) << pixel;
    }
}

} // namespace relamp
