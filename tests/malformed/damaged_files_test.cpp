// Files that were right once: cut off, or with a bit turned over.
//
// Most are read in this process, for speed; a few of each sort go through the whole program.

#include "malformed/run_in_folder.h"
#include "relamp/error.h"
#include "relamp/image.h"
#include "relamp/scan.h"
#include "scenes/gltf_files.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <ostream>

#include <gmock/gmock.h>

namespace relamp::malformed
{
namespace
{

using testing::StartsWith;

/// A scan, and which part of it to damage.
struct Sort
{
    const char* what;
    std::function<SmallScan()> scan;
    const char* part; // "" is the scan itself, else one of the files beside
    bool showsCuts;   // the format itself tells where a file ends
};

SmallScan dracoGlb()
{
    return {"room.glb", scenes::dracoSquare().glb(), {}};
}

SmallScan meshoptGlb()
{
    return {"room.glb", scenes::meshoptSquare().glb(), {}};
}

void PrintTo(const Sort& sort, std::ostream* out)
{
    *out << sort.what;
}

std::vector<Sort> sorts()
{
    return {{"Glb", smallGlb, "", true},
            {"DracoGlb", dracoGlb, "", true},
            {"MeshoptGlb", meshoptGlb, "", true},
            {"Obj", smallObj, "", false},
            {"Mtl", smallObj, "room.mtl", false},
            {"TextPly", smallTextPly, "", false},
            {"BinaryPly", smallBinaryPly, "", true},
            {"Jpeg", [] { return smallTexturedPly("jpeg"); }, "room.jpeg", true},
            {"Png", [] { return smallTexturedPly("png"); }, "room.png", true}};
}

class Damaged : public RunInFolder, public testing::WithParamInterface<Sort>
{
protected:
    void SetUp() override
    {
        const Sort& sort = GetParam();
        scan_ = sort.scan();
        write(scan_);
        part_ = *sort.part == '\0' ? scan_.name : sort.part;
        whole_ = *sort.part == '\0' ? scan_.bytes : scan_.beside.at(sort.part);
    }

    /// What the scan is refused with, "" where it is read; then it holds what Mesh promises.
    std::string refusal(const std::string& bytes) const
    {
        write(part_, bytes);
        try {
            Progress progress;
            expectSound(readScan(folder / scan_.name, {}, progress));
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), StartsWith(folder.path().string()));
            return error.what();
        }
        return "";
    }

    static void expectSound(const Scan& scan)
    {
        for (const Mesh& mesh : scan.meshes) {
            for (const glm::vec3& p : mesh.positions) EXPECT_TRUE(std::isfinite(p.x + p.y + p.z));
            for (const glm::uvec3& t : mesh.triangles)
                EXPECT_LT(std::max({t.x, t.y, t.z}), mesh.positions.size());
            ASSERT_LT(static_cast<size_t>(mesh.page), scan.pages.size());
        }
        for (const Page& page : scan.pages)
            EXPECT_EQ(std::visit([](const auto& rgb) { return rgb.size(); }, page.image.rgb),
                      3 * page.image.pixels());
    }

    SmallScan scan_;
    std::string part_;
    std::string whole_;
};

std::string nameOf(const testing::TestParamInfo<Sort>& info)
{
    return info.param.what;
}

constexpr size_t kReadings = 100;
constexpr size_t kRuns = 2;

} // namespace

TEST_P(Damaged, UndamagedItIsTaken)
{
    EXPECT_EQ(refusal(whole_), "");
    expectTaken(scan_.name);
}

TEST_P(Damaged, CutOffItDoesNoHarm)
{
    for (const size_t length : scattered(kReadings, whole_.size())) {
        const bool isTaken = refusal(whole_.substr(0, length)).empty();
        EXPECT_FALSE(isTaken && GetParam().showsCuts) << length;
    }
}

TEST_P(Damaged, WithABitTurnedOverItDoesNoHarm)
{
    for (const size_t bit : scattered(kReadings, 8 * whole_.size())) {
        SCOPED_TRACE(bit);
        refusal(flipped(whole_, bit));
    }
}

TEST_P(Damaged, TheProgramEndsWithAResultOrASentence)
{
    for (size_t i = 1; i <= kRuns; ++i) {
        write(part_, whole_.substr(0, whole_.size() * i / (kRuns + 1)));
        expectResultOrSentence(scan_.name);
    }
    for (const size_t bit : scattered(kRuns, 8 * whole_.size())) {
        SCOPED_TRACE(bit);
        write(part_, flipped(whole_, bit));
        expectResultOrSentence(scan_.name);
    }
}

INSTANTIATE_TEST_SUITE_P(File, Damaged, testing::ValuesIn(sorts()), nameOf);

} // namespace relamp::malformed
