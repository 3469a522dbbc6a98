#include "relamp/film.h"

#include "relamp/error.h"
#include "scenes/refusal.h"
#include "scenes/scenes.h"
#include "scenes/temporary_folder.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace relamp
{
namespace
{

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A white box with a lamp in its middle.
class FilmOfABox : public testing::Test
{
protected:
    FilmOfABox() : photographer(relighter())
    {
        film.camera = {.position = {1.0f, 1.2f, 1.0f}};
        film.picture.width = 32;
        film.picture.height = 18;
    }

    Relighter& relighter()
    {
        if (relighter_) return *relighter_;
        room_.scan = std::make_shared<const Scan>(
            scenes::room({3.0f, 2.5f, 4.0f}, 16, scenes::plain(glm::vec3(0.5f))));
        room_.albedo = {room_.scan->pages[0].image};
        relighter_ = std::make_unique<Relighter>(room_, RelightOptions{.rays = 16}, progress);
        Relighting lighting;
        lighting.lights = {{.emission = glm::vec3(1.0f), .position = {1.5f, 1.5f, 2.0f}}};
        relighter_->light(lighting, progress);
        return *relighter_;
    }

    void write(const std::string& target)
    {
        writeFilm(relighter(), photographer, film, folder / target, progress);
    }

    [[nodiscard]] std::vector<std::string> names(const std::string& in = "") const
    {
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(folder / in))
            names.push_back(entry.path().filename());
        std::sort(names.begin(), names.end());
        return names;
    }

    /// A program ffmpeg for this test alone: a shell script.
    void putFfmpeg(const std::string& script)
    {
        std::filesystem::create_directory(folder / "bin");
        const auto file = folder.write("bin/ffmpeg", "#!/bin/sh\n" + script + "\n");
        std::filesystem::permissions(file, std::filesystem::perms(0755));
        setPath((folder / "bin").string() + ":/usr/bin:/bin");
    }
    static void setPath(const std::string& path) { setenv("PATH", path.c_str(), 1); }
    void TearDown() override { setPath(path_); }

    std::string refusal(const std::string& target)
    {
        return scenes::refusalOf([&] { write(target); });
    }

    Progress progress;
    scenes::TemporaryFolder folder;
    Film film{.frames = 3};
    DelitRoom room_;
    std::unique_ptr<Relighter> relighter_;
    Photographer photographer;

private:
    std::string path_ = std::getenv("PATH");
};

std::string contentOf(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

} // namespace

TEST_F(FilmOfABox, FramesAreNumberedAndALongerFilmLeavesNone)
{
    film.turns = true;
    write("frames");
    folder.write("frames/notes.txt", std::string("mine"));
    EXPECT_THAT(names("frames"), ElementsAre("film.json", "frame_0001.png", "frame_0002.png",
                                             "frame_0003.png", "notes.txt"));
    EXPECT_NE(contentOf(folder / "frames/frame_0001.png"),
              contentOf(folder / "frames/frame_0002.png"));
    film.frames = 2;
    write("frames");
    EXPECT_THAT(names("frames"),
                ElementsAre("film.json", "frame_0001.png", "frame_0002.png", "notes.txt"));
}

TEST_F(FilmOfABox, AStrangersFramesStayUnlessTheyMayGo)
{
    std::filesystem::create_directory(folder / "frames");
    folder.write("frames/frame_0007.png", std::string("mine"));
    EXPECT_THAT(refusal("frames"), testing::HasSubstr("frame_0007.png"));
    EXPECT_THAT(names("frames"), ElementsAre("frame_0007.png"));
    film.replacing = Replacing::any;
    write("frames");
    EXPECT_THAT(names("frames"), ElementsAre("film.json", "frame_0001.png", "frame_0002.png",
                                             "frame_0003.png", "frame_0007.png"));
}

// A film of the same frame shows what a single picture does.
TEST_F(FilmOfABox, AFrameIsThePictureOfItsLight)
{
    film.frames = 1;
    write("frames");
    const std::vector<Image> pages = radianceOfPages(relighter(), progress);
    photographer.write(pages, film.camera, film.picture, folder / "one.png", progress);
    EXPECT_EQ(contentOf(folder / "frames/frame_0001.png"), contentOf(folder / "one.png"));
}

// ffmpeg gets every frame as plain bytes, and where to write.
TEST_F(FilmOfABox, VideoIsWhatFfmpegMakesOfTheFrames)
{
    putFfmpeg("for last; do :; done; cat > \"$last\"");
    write("film.mp4");
    EXPECT_EQ(std::filesystem::file_size(folder / "film.mp4"), 3u * 3 * 32 * 18);
    EXPECT_THAT(names(), ElementsAre("bin", "film.mp4"));
}

TEST_F(FilmOfABox, WithoutAnFfmpegThatWorksThereIsASentenceAndNoFile)
{
    setPath(folder.path().string());
    EXPECT_THAT(refusal("film.mp4"), HasSubstr("apt install ffmpeg"));
    putFfmpeg("echo 'Unknown encoder' >&2; exit 1");
    EXPECT_THAT(refusal("film.mp4"), HasSubstr("film.mp4: ffmpeg has given up: Unknown encoder"));
    putFfmpeg("cat > /dev/null; echo 'disk full' >&2; exit 3");
    EXPECT_THAT(refusal("film.mp4"), HasSubstr("disk full"));
    film.picture.width = 31;
    EXPECT_THAT(refusal("film.mp4"), HasSubstr("must be even"));
    EXPECT_THAT(names(), ElementsAre("bin"));
}

TEST_F(FilmOfABox, ACancelledFilmLeavesNothing)
{
    putFfmpeg("cat > /dev/null");
    relighter();
    progress.cancel();
    EXPECT_THROW(write("film.mp4"), Error);
    EXPECT_THROW(write("frames"), Error);
    EXPECT_THAT(names(), ElementsAre("bin"));
}

TEST_F(FilmOfABox, TwiceTheLightIsAStopLess)
{
    const auto exposure = [&] {
        return photographer.automaticExposure(radianceOfPages(relighter(), progress), film.camera,
                                              film.picture, progress);
    };
    const float before = exposure();
    Relighting lighting;
    lighting.lights = {{.emission = glm::vec3(2.0f), .position = {1.5f, 1.5f, 2.0f}}};
    relighter().light(lighting, progress);
    EXPECT_NEAR(exposure(), before - 1.0f, 0.02f);
}

// From the middle of a wall the camera looks at it, and then into the room: each picture alone
// would be exposed its own way, and the film would flicker.
TEST_F(FilmOfABox, AFilmHasOneExposureForAllItsFrames)
{
    film.turns = true;
    film.camera.position = {0.2f, 1.2f, 2.0f};
    const std::vector<Image> pages = radianceOfPages(relighter(), progress);
    float least = 99.0f;
    float most = -99.0f;
    double sum = 0.0;
    for (int frame = 0; frame < film.frames; ++frame) {
        const Camera camera = turned(film.camera, *room_.scan, frame / 3.0);
        const float stops = photographer.automaticExposure(pages, camera, film.picture, progress);
        least = std::min(least, stops);
        most = std::max(most, stops);
        sum += stops;
    }
    EXPECT_GT(most - least, 0.1f);
    // All pixels of all frames count alike, and there is no black in a box.
    EXPECT_NEAR(automaticExposure(relighter(), photographer, film, progress), sum / 3.0, 0.01);
}

// Inside, a turntable turns the camera where it stands; outside, it goes around the room.
TEST_F(FilmOfABox, ATurnLeadsBackToWhereItBegan)
{
    const Camera inside = turned(film.camera, *room_.scan, 0.25);
    EXPECT_EQ(inside.position, film.camera.position);
    EXPECT_LT(glm::length(inside.forward - glm::vec3(1.0f, 0.0f, 0.0f)), 1e-6f);

    const Camera before{.position = {1.5f, 1.25f, 10.0f}};
    const Camera beside = turned(before, *room_.scan, 0.25);
    EXPECT_LT(glm::length(beside.position - glm::vec3(-6.5f, 1.25f, 2.0f)), 1e-5f);
    EXPECT_LT(glm::length(beside.forward - glm::vec3(1.0f, 0.0f, 0.0f)), 1e-6f);
    EXPECT_LT(glm::length(turned(before, *room_.scan, 1.0).position - before.position), 1e-4f);
}

} // namespace relamp
