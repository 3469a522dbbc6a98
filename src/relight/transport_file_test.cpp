#include "relight/transport_file.h"

#include "base/file.h"
#include "relamp/error.h"
#include "scenes/scenes.h"
#include "scenes/surfaces.h"
#include "scenes/temporary_folder.h"

#include <limits>

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

constexpr uint64_t kKey = 7;

struct Kept
{
    Kept()
        : surfaces(scenes::room({2, 2, 2}, 16, scenes::plain(glm::vec3(0.5f)))),
          transport(transportOf(surfaces.texels, scenes::hitListsOf(surfaces, 4))),
          file(folder / "transport.bin")
    {
        saveTransport(file, kKey, transport);
    }

    [[nodiscard]] std::optional<Transport> load(uint64_t key = kKey) const
    {
        return loadTransport(file, key, surfaces.texels);
    }

    scenes::TemporaryFolder folder;
    scenes::Surfaces surfaces;
    Transport transport;
    std::filesystem::path file;
};

} // namespace

TEST(TransportFile, WhatWasWrittenIsReadAgain)
{
    const Kept kept;
    const auto again = kept.load();
    ASSERT_TRUE(again);
    EXPECT_EQ(again->clusterOf, kept.transport.clusterOf);
    EXPECT_EQ(again->ofFronts.target, kept.transport.ofFronts.target);
    EXPECT_EQ(again->ofClusters.first, kept.transport.ofClusters.first);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(kept.folder.path()), {}), 1);
}

TEST(TransportFile, OfAnotherRoomIsNone)
{
    const Kept kept;
    EXPECT_FALSE(kept.load(kKey + 1));
    const scenes::Surfaces other(scenes::room({2, 2, 3}, 16, scenes::plain(glm::vec3(0.5f))));
    EXPECT_FALSE(loadTransport(kept.folder / "nothing", kKey, kept.surfaces.texels));
    EXPECT_NE(keyOfTransport(kept.surfaces.texels, 64), keyOfTransport(other.texels, 64));
    EXPECT_NE(keyOfTransport(kept.surfaces.texels, 64), keyOfTransport(kept.surfaces.texels, 32));
}

TEST(TransportFile, CutOrChangedAnywhereIsNone)
{
    const Kept kept;
    const std::vector<std::byte> whole = readFile(kept.file);
    for (size_t i = 1; i < 40; ++i) {
        const size_t at = whole.size() * i / 40;
        writeFile(kept.file, std::span(whole).first(at));
        EXPECT_FALSE(kept.load()) << "cut at " << at;
        std::vector<std::byte> changed = whole;
        changed[at] ^= std::byte{16};
        writeFile(kept.file, changed);
        EXPECT_FALSE(kept.load()) << "changed at " << at;
    }
    writeFile(kept.file, whole);
    EXPECT_TRUE(kept.load());
}

// Even with the right checksum no index leads astray and no number spoils the rest.
TEST(TransportFile, IndicesBeyondTheRoomAndWhatIsNoNumberAreNone)
{
    Kept kept;
    const Transport good = kept.transport;
    const auto isRefused = [&](const auto& spoil) {
        kept.transport = good;
        spoil(kept.transport);
        saveTransport(kept.file, kKey, kept.transport);
        return !kept.load();
    };
    EXPECT_TRUE(isRefused([](Transport& t) { t.ofFronts.target[5] = 1u << 30; }));
    EXPECT_TRUE(isRefused([](Transport& t) { t.ofClusters.target[5] = 1u << 30; }));
    EXPECT_TRUE(isRefused([](Transport& t) { t.clusterOf[5] = 1u << 30; }));
    EXPECT_TRUE(isRefused([](Transport& t) { t.sides[5].index = 1u << 30; }));
    EXPECT_TRUE(isRefused([](Transport& t) { t.ofFronts.first[5] = t.ofFronts.first[4]; }));
    EXPECT_TRUE(isRefused([](Transport& t) { t.weight.pop_back(); }));
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_TRUE(isRefused([](Transport& t) { t.weight[5] = kNan; }));
    EXPECT_TRUE(isRefused([](Transport& t) { t.weight[5] = 1e30f; }));
    EXPECT_FALSE(isRefused([](Transport&) {}));
}

} // namespace relamp
