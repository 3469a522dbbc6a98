// Scans that are no files, and results that have nowhere to go.

#include "malformed/run_in_folder.h"

#include <fstream>

#include <gmock/gmock.h>
#include <sys/resource.h>

namespace relamp::malformed
{
namespace
{

using testing::HasSubstr;
using testing::StartsWith;

using Scan = RunInFolder;
using Output = RunInFolder;
using LightsFile = RunInFolder;
using ResponseFile = RunInFolder;

/// As if the disk were full: no file of this process, or of one that it starts, grows beyond.
class FileSizeLimit
{
public:
    explicit FileSizeLimit(rlim_t bytes)
    {
        getrlimit(RLIMIT_FSIZE, &former_);
        const rlimit limit{bytes, former_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileSizeLimit() { setrlimit(RLIMIT_FSIZE, &former_); }
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;

private:
    rlimit former_{};
};

class FullDisk : public RunInFolder
{
protected:
    [[nodiscard]] golden::Outcome delightWithin(rlim_t bytes) const
    {
        const FileSizeLimit full(bytes);
        return golden::runRelamp({"delight", folder / "room.ply", "-o", folder / "out", "-q"});
    }
};

} // namespace

TEST_F(Scan, ThatIsNotThereIsNamed)
{
    expectRefused("gone.glb", "no such file");
    expectRefused(std::string(300, 'a') + ".glb", "no such file");
}

TEST_F(Scan, ThatIsAFolderIsNamed)
{
    std::filesystem::create_directory(folder / "room.glb");
    expectRefused("room.glb", "is a directory, not a file");
}

TEST_F(Scan, ThatIsADeviceIsNamed)
{
    std::filesystem::create_symlink("/dev/zero", folder / "room.ply");
    expectRefused("room.ply", "is not a regular file");
}

TEST_F(Scan, WithoutAByteIsNamed)
{
    for (const char* name : {"room.glb", "room.obj", "room.ply", "room"}) {
        write(name, std::string());
        expectRefused(name, "is empty (0 bytes)");
    }
}

TEST_F(Scan, OfNoFormatIsNamed)
{
    for (const char* name : {"room.glb", "room.gltf", "room.obj", "room.ply", "room.fbx",
                             "room.dae", "room.stl", "room.blend", "room.jpg", "room"}) {
        write(name, "This is no scan.\n");
        expectRefused(name, "");
    }
}

TEST_F(Output, UnderAFileIsNamed)
{
    write(smallTextPly());
    const std::string ply = folder / "room.ply";
    for (const std::string& place : {ply, ply + "/below"}) {
        const golden::Outcome run = golden::runRelamp({"delight", ply, "-o", place});
        EXPECT_EQ(run.exitCode, 1);
        EXPECT_THAT(run.err, StartsWith("relamp: " + place)); // before any work is done
    }
    EXPECT_THAT(names(), testing::ElementsAre("room.ply"));
}

TEST_F(Output, WithoutANameIsRefused)
{
    write(smallTextPly());
    const golden::Outcome run = golden::runRelamp({"delight", folder / "room.ply", "-o", ""});
    EXPECT_EQ(run.exitCode, 2);
    EXPECT_THAT(run.err, StartsWith("relamp: --output: is empty"));
}

// Each limit strikes another file of the result; the preview needs the most.
TEST_F(FullDisk, LeavesNothingHalfWritten)
{
    write(smallTextPly());
    for (const rlim_t bytes : {0u, 250u, 800u, 1300u, 20'000u}) {
        SCOPED_TRACE(bytes);
        const golden::Outcome run = delightWithin(bytes);
        EXPECT_EQ(run.exitCode, 1);
        EXPECT_THAT(names(), testing::ElementsAre("room.ply"));
        if (bytes < 250) continue; // what it says is written to a file as well
        EXPECT_THAT(run.err, StartsWith("relamp: " + folder.path().string()));
        EXPECT_THAT(run.err, HasSubstr("cannot be written: File too large"));
    }
}

TEST_F(FullDisk, LeavesTheFormerResultAlone)
{
    write(smallTextPly());
    ASSERT_EQ(delight("room.ply", {"-q"}).exitCode, 0);
    const auto before = std::filesystem::last_write_time(folder / "out/report.json");
    EXPECT_EQ(delightWithin(1300).exitCode, 1);
    EXPECT_EQ(std::filesystem::last_write_time(folder / "out/report.json"), before);
    EXPECT_THAT(names(), testing::ElementsAre("out", "room.ply"));
}

TEST_F(ResponseFile, ThatIsNoneIsNamed)
{
    write(smallTextPly());
    const std::string file = folder / "camera.json";
    const std::vector<std::pair<std::string, std::string>> files{
        {"", "is empty"},
        {"{", "camera.json"},
        {"[]", "camera.json"},
        {R"({"lights": []})", "tells no camera; name the lights.json or report.json"},
        {R"({"camera": {"response": [1, 1, 1]}})", "must be 5 slopes"},
        {R"({"camera": {"response": [1, 1, 1, 1, 99]}})", "its numbers are 0.1 to 10"},
        {R"({"camera": {"response": [1, 1, 1, 1, "x"]}})", "\"response\" has"},
        {R"({"camera": {"response": 1}})", "needs \"response\", a list of numbers"},
        {R"({"lights": {"camera": {"model": {"response": [0]}}}})", "line 1"}};
    for (const auto& [text, words] : files) {
        SCOPED_TRACE(text);
        write("camera.json", text);
        const golden::Outcome run = delight("room.ply", {"-q", "--response", file});
        EXPECT_EQ(run.exitCode, 1);
        EXPECT_THAT(run.err, StartsWith("relamp: " + file));
        EXPECT_THAT(run.err, HasSubstr(words));
        EXPECT_FALSE(std::filesystem::exists(folder / "out"));
    }
    EXPECT_THAT(delight("room.ply", {"-q", "--response", folder / "gone.json"}).err,
                HasSubstr("no such file"));
}

TEST_F(LightsFile, ThatIsBrokenIsNamed)
{
    write(smallTextPly());
    const std::string lights = folder / "lights.json";
    for (const std::string& text :
         {std::string(), std::string("{"), std::string("[]"), std::string(300'000, '['),
          std::string(R"({"format": "relamp lights 1", "lights": [{"type": "sun"}]})"),
          std::string(R"({"format": "relamp lights 1", "lights": 1e999})")}) {
        write("lights.json", text);
        const golden::Outcome run = delight("room.ply", {"-q", "--lights", lights});
        EXPECT_EQ(run.exitCode, 1) << text.substr(0, 80);
        EXPECT_THAT(run.err, StartsWith("relamp: " + lights)) << text.substr(0, 80);
        EXPECT_FALSE(std::filesystem::exists(folder / "out"));
    }
}

} // namespace relamp::malformed
