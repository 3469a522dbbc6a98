#pragma once

#include "relamp/api.h"
#include "relamp/camera.h"
#include "relamp/image.h"
#include "relamp/progress.h"
#include "relamp/relight.h"
#include "relamp/view.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace relamp
{

struct PictureOptions
{
    int width = 1280; // pixels, 1..16384
    int height = 720;
    int samples = 2;             // rays through a pixel, along each of its sides, 1..16
    ViewOptions view;            // of pictures for people; EXR and `take` give the light itself
    Sky sky;                     // seen through holes of the scan
    std::vector<NewLight> lamps; // seen themselves, if they have a surface; as bright as they shine
};

/// Takes pictures of a room, whatever light is on its walls. What it takes them of must outlive it.
class RELAMP_API Photographer
{
public:
    /// Of a room that is relit; shares what the relighter knows of it.
    explicit Photographer(const Relighter& relighter);
    /// Of a room in the light of its scan, or of none.
    explicit Photographer(const DelitRoom& room, Progress& progress = unwatched());
    explicit Photographer(DelitRoom&& room, Progress& progress = unwatched()) = delete;
    ~Photographer();
    Photographer(Photographer&&) noexcept;
    Photographer& operator=(Photographer&&) noexcept;

    /// A view from inside the room that shows much of it.
    [[nodiscard]] Camera goodView() const;
    /// A view from where most of the room is seen in one turn.
    [[nodiscard]] Camera goodPlaceToTurn() const;

    /// How far `from` lies, in m, from the first surface along each of `directions` (unit) that
    /// faces it: backs are looked past. Infinity where there is none.
    [[nodiscard]] std::vector<float> distancesSeen(glm::vec3 from,
                                                   std::span<const glm::vec3> directions) const;

    /// What the camera sees where `pages`, a picture a page of the scan, is the light on the walls:
    /// linear half RGB. A hole shows the sky; from inside, the back of a surface is black.
    [[nodiscard]] Image take(std::span<const Image> pages, const Camera& camera,
                             const PictureOptions& options = {},
                             Progress& progress = unwatched()) const;

    /// Stops for `options.view` that bring the log-average luminance of what is seen to middle
    /// grey, 0.18: Reinhard et al., Photographic Tone Reproduction for Digital Images, 2002,
    /// equations 1 and 2. Black counts for nothing; 0 where all is black. Measured on a small
    /// picture.
    [[nodiscard]] float automaticExposure(std::span<const Image> pages, const Camera& camera,
                                          const PictureOptions& options = {},
                                          Progress& progress = unwatched()) const;

    /// The same through the view, for people: sRGB, three bytes a pixel.
    [[nodiscard]] std::vector<uint8_t> develop(std::span<const Image> pages, const Camera& camera,
                                               const PictureOptions& options = {},
                                               Progress& progress = unwatched()) const;

    /// Writes what `develop` gives as .png, or what `take` gives as .exr, whole or not at all.
    /// Throws Error(cannotWrite | cancelled).
    void write(std::span<const Image> pages, const Camera& camera, const PictureOptions& options,
               const std::filesystem::path& file, Progress& progress = unwatched()) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// The camera that a person asks for: a number is the scan's own camera of that index (glTF), all
/// else a camera file, described in docs/guide/relighting.md. `warnings` receives a sentence a key
/// that was passed over. Throws Error(cannotRead | malformed), and Error(unsupported) where the
/// scan has no such camera.
RELAMP_API Camera cameraFor(const std::string& choice, const Scan& scan,
                            std::vector<std::string>& warnings);

/// The same camera a part of a full turn on: from inside the room it turns where it stands, from
/// outside it goes around the room.
RELAMP_API Camera turned(const Camera& camera, const Scan& scan, double partOfTurn);

/// Radiance of all pages under the light that was set.
RELAMP_API std::vector<Image> radianceOfPages(const Relighter& relighter,
                                              Progress& progress = unwatched());

} // namespace relamp
