#include "relamp/picture.h"

#include "base/fail.h"
#include "base/file.h"
#include "base/half.h"
#include "image/light_meter.h"
#include "image/transfer.h"
#include "image/view_transform.h"
#include "output/camera_file.h"
#include "output/room_view.h"
#include "output/small_picture.h"
#include "output/staged_file.h"
#include "output/viewpoints.h"
#include "relamp/printable.h"
#include "relight/relighter_state.h"
#include "relight/sky_bins.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <glm/common.hpp>
#include <glm/gtc/constants.hpp>

namespace relamp
{
namespace
{

/// A room's geometry, where no relighter has it.
struct OwnRoom
{
    OwnRoom(const Scan& scan, Progress& progress)
        : texels(rasterizeAtlas(scan, progress)), scene(scan)
    {}

    Texels texels;
    RayScene scene;
};

/// Index of a camera, if `choice` is a number.
std::optional<int> indexFrom(const std::string& choice)
{
    const auto isDigit = [](char c) { return c >= '0' && c <= '9'; };
    if (choice.empty() || choice.size() > 6 || !std::all_of(choice.begin(), choice.end(), isDigit))
        return {};
    return std::stoi(choice);
}

Camera cameraOfFile(const Scan& scan, int index)
{
    std::string has;
    for (const ScanCamera& camera : scan.cameras) {
        if (camera.index == index) return camera.camera;
        has += fmt::format("{}{} \"{}\"", has.empty() ? "" : ", ", camera.index,
                           printableName(camera.name));
    }
    fail(ErrorCode::unsupported, scan.title(),
         has.empty() ? fmt::format("has no camera {}, and no other; use --camera auto, or name a "
                                   "camera file",
                                   index)
                     : fmt::format("has no camera {}; it has {}", index, has));
}

float distanceToFront(const RayScene& scene, Ray ray)
{
    constexpr int kMostBacks = 64;   // of thin things in a heap
    constexpr float kBehind = 1e-5f; // m, and of the way: past a back
    for (int backs = 0; backs < kMostBacks; ++backs) {
        const Hit hit = scene.intersect(ray);
        if (hit.missed()) break;
        if (hit.front) return hit.distance;
        ray.nearest = hit.distance * (1.0f + kBehind) + kBehind;
    }
    return std::numeric_limits<float>::infinity();
}

Image imageOf(const std::vector<glm::vec3>& light, Size size)
{
    Image image;
    image.width = size.width;
    image.height = size.height;
    image.transfer = Transfer::linear;
    image.clipsAtWhite = false;
    std::vector<uint16_t> rgb(3 * light.size());
    forEachChunk(light.size(), 4096, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i)
            for (int c = 0; c < 3; ++c)
                rgb[3 * i + static_cast<size_t>(c)] = halfFromFloat(light[i][c]);
    });
    image.rgb = std::move(rgb);
    return image;
}

} // namespace

struct Photographer::State
{
    State(const Texels& texels, const RayScene& rays) : scene(rays), view(texels, rays) {}
    explicit State(std::unique_ptr<OwnRoom> room)
        : own(std::move(room)), scene(own->scene), view(own->texels, own->scene)
    {}

    [[nodiscard]] const Scan& scan() const { return view.scan(); }

    [[nodiscard]] std::vector<glm::vec3> look(std::span<const Image> pages, const Camera& camera,
                                              const PictureOptions& options,
                                              Progress& progress) const
    {
        const SeenSky sky(options.sky);
        return view.look(CameraRays(camera, {options.width, options.height}), options.samples,
                         pages, {.beyond = sky, .lamps = seenLamps(options.lamps)}, progress);
    }

    std::unique_ptr<OwnRoom> own; // null where a relighter has it
    const RayScene& scene;
    RoomView view;
};

Photographer::Photographer(const Relighter& relighter)
    : state_(std::make_unique<State>(relighter.state().texels, relighter.state().scene))
{}

Photographer::Photographer(const DelitRoom& room, Progress& progress)
    : state_(std::make_unique<State>(std::make_unique<OwnRoom>(*room.scan, progress)))
{}

Photographer::~Photographer() = default;
Photographer::Photographer(Photographer&&) noexcept = default;
Photographer& Photographer::operator=(Photographer&&) noexcept = default;

Camera Photographer::goodView() const
{
    return chooseViewpoints(state_->scan(), state_->scene, 1).front();
}

Camera Photographer::goodPlaceToTurn() const
{
    return chooseTurningPlace(state_->scan(), state_->scene);
}

std::vector<float> Photographer::distancesSeen(glm::vec3 from,
                                               std::span<const glm::vec3> directions) const
{
    std::vector<float> distances(directions.size());
    forEachChunk(directions.size(), 64, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i)
            distances[i] = distanceToFront(state_->scene, {from, directions[i]});
    });
    return distances;
}

Image Photographer::take(std::span<const Image> pages, const Camera& camera,
                         const PictureOptions& options, Progress& progress) const
{
    return imageOf(state_->look(pages, camera, options, progress), {options.width, options.height});
}

float Photographer::automaticExposure(std::span<const Image> pages, const Camera& camera,
                                      const PictureOptions& options, Progress& progress) const
{
    LightMeter meter;
    meter.add(take(pages, camera, smallPicture(options), progress));
    return meter.exposure();
}

std::vector<uint8_t> Photographer::develop(std::span<const Image> pages, const Camera& camera,
                                           const PictureOptions& options, Progress& progress) const
{
    const ViewTransform view(options.view);
    const auto light = state_->look(pages, camera, options, progress);
    const SrgbFromHalf srgb;
    std::vector<uint8_t> rgb(3 * light.size());
    forEachChunk(light.size(), 4096, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const glm::vec3 shown = view.displayed(light[i]);
            for (int c = 0; c < 3; ++c)
                rgb[3 * i + static_cast<size_t>(c)] = srgb(halfFromFloat(shown[c]));
        }
    });
    return rgb;
}

void Photographer::write(std::span<const Image> pages, const Camera& camera,
                         const PictureOptions& options, const std::filesystem::path& file,
                         Progress& progress) const
{
    const Size size{options.width, options.height};
    StagedFile staged(file, progress);
    if (file.extension() == ".exr") {
        writeExr(staged.path(), take(pages, camera, options, progress).half(), size);
    } else {
        const auto png = encodePng(develop(pages, camera, options, progress), size, 3);
        writeFile(staged.path(), std::as_bytes(std::span(png)));
    }
    progress.check();
    staged.commit();
}

Camera cameraFor(const std::string& choice, const Scan& scan, std::vector<std::string>& warnings)
{
    if (const auto index = indexFrom(choice)) return cameraOfFile(scan, *index);
    return readCamera(choice, warnings);
}

Camera turned(const Camera& camera, const Scan& scan, double partOfTurn)
{
    const auto angle = static_cast<float>(glm::two_pi<double>() * partOfTurn);
    const auto turn = [angle](glm::vec3 v) { // about the vertical, from -z to +x
        return glm::vec3(std::cos(angle) * v.x - std::sin(angle) * v.z, v.y,
                         std::sin(angle) * v.x + std::cos(angle) * v.z);
    };
    Camera next = camera;
    next.forward = turn(camera.forward);
    next.up = turn(camera.up);
    const Bounds box = boundsOf(scan);
    if (!box.contains(camera.position))
        next.position = box.centre() + turn(camera.position - box.centre());
    return next;
}

std::vector<Image> radianceOfPages(const Relighter& relighter, Progress& progress)
{
    std::vector<Image> pages;
    for (size_t page = 0; page < relighter.room().scan->pages.size(); ++page)
        pages.push_back(relighter.radiance(page, progress));
    return pages;
}

} // namespace relamp
