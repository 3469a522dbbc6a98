#pragma once

#include "relamp/api.h"
#include "relamp/devices.h"
#include "relamp/gather.h"
#include "relamp/lights.h"
#include "relamp/pathtrace.h"
#include "relamp/progress.h"
#include "relamp/scan.h"
#include "relamp/thesis.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

struct AlbedoOptions
{
    float darkest = 0.005f; // radiance, > 0; a weaker shading is believed the less the darker it is
    bool fill = false;      // what is unlit gets the albedo of the surface around it, and by the
                            // thesis solver what is burnt out: others see to that by themselves

    bool operator==(const AlbedoOptions&) const = default;
};

enum class Solver {
    gather,    // area lights with shadows, bounce light gathered from the scan itself
    pathtrace, // the same lights, every bounce simulated: slow, the reference
    thesis     // Choi 2018
};

/// How much of the light that lamps and walls bring to the texels of one page is there, where the
/// rest leaks in through what the mesh lacks; more than all where the mesh throws a shadow that the
/// texture does not show: docs/method/light_correction.md.
struct CorrectionMap
{
    static constexpr uint8_t kAll = 200; // all of it is there; 0: none, up to 255

    int width = 0;
    int height = 0;
    std::vector<uint8_t> share; // width * height, 0 off the surface; empty: none was corrected

    [[nodiscard]] bool isEmpty() const { return share.empty(); }
};

struct DelightOptions
{
    Solver solver = Solver::gather;
    GatherOptions gather; // of the solver pathtrace, too
    PathtraceOptions pathtrace;
    ThesisOptions thesis;
    AlbedoOptions albedo;
    std::optional<Lights> lights; // instead of looking for them: nothing is searched
    // Of `lights`, whose texels are whose, a page each, as Decomposition::fixtures() and
    // readFixturesBeside() give them. Empty: lamps are what is burnt out at their places.
    std::vector<FixtureMap> fixtures;
    EngineOptions engine; // of the solver thesis, and of the solver gather once it knows lamps,
                          // and how to correct their light; all else is the CPU's
};

/// Why an albedo cannot be believed.
enum class Doubt : uint8_t {
    none,
    clipped,         // the texture is burnt out there
    shines,          // it is a lamp; its own colour cannot be seen
    unlit,           // so little light that the division is a guess, or noise of the texture
    unseen,          // most of what lights it is not in the scan
    backFace,        // most of what it faces is seen from behind, where the texture says nothing
    penumbra,        // a shadow's edge is near, or the light found had to be corrected by much
    whiterThanPaper, // it got more light than was found, or shines by polish
    shared,          // the texel stands for several places in different light
    unproven         // places of one paint, which no fit looked at, do not agree under the shading
};
constexpr size_t kDoubts = 10;

/// What delight makes of one page: pictures of the page's size. RGB as linear IEEE half floats,
/// 3 * width * height; pixels that no surface covers continue what lies next to them.
struct PageLayers
{
    int width = 0;
    int height = 0;
    std::vector<uint16_t> albedo;       // 0..0.87: no paper is whiter
    std::vector<uint16_t> direct;       // irradiance / pi straight from the lights
    std::vector<uint16_t> indirect;     // irradiance / pi by way of other surfaces, and ambient
    std::vector<uint8_t> emission;      // sRGB of texels that shine, else 0; empty where none does
    std::vector<uint8_t> confidence;    // 0: a guess .. 255
    std::vector<Doubt> doubt;           // what speaks most against it where confidence is below 128
    std::array<double, kDoubts> area{}; // m^2 of surface by `doubt`
};

/// Where the texels of a page lie: three floats a pixel, 3 * width * height. 0 where no surface is,
/// so that a normal of 0 tells these pixels.
struct PageGeometry
{
    int width = 0;
    int height = 0;
    std::vector<float> positions; // world, m
    std::vector<float> normals;   // unit
};

/// How well the result explains the scan.
struct Closure
{
    float rmsError = 0.0f; // of albedo * own shading against the texture, in radiance
    float rmsInput = 0.0f; // of the texture itself, for comparison
};

/// Whether albedo is more even than the scan, under light that is found without looking at the
/// places measured: by how much do those differ that are of one paint? In stops, root mean square
/// over the channels, as half of such pairs do at most where half of all pairs are of one paint.
/// See docs/method/cross_validation.md.
struct CrossValidation
{
    size_t pairs = 0;          // that were looked at; 0: there were too few to tell
    float scan = 0.0f;         // stops, of what the texture shows
    float albedo = 0.0f;       // stops, of albedo as it is
    float chromaOfScan = 0.0f; // the same without the mean of the channels
    float chromaOfAlbedo = 0.0f;
    float shadingPower = 1.0f; // 0..1, that the shading found was taken to; less than 1: it was
                               // clearly too strong; 0: the scan itself is the albedo
    bool improves = true;      // false: pairs agree clearly better in the scan

    [[nodiscard]] RELAMP_API float gain() const; // dB, 20 log10 of `scan` over `albedo`
};

/// A large hole of a scan, which light comes through that is not in it: a window, a door, a ceiling
/// that was not scanned.
struct Opening
{
    glm::vec3 centre{0.0f};   // world, m: of where rays leave the box around the scan
    glm::vec3 normal{0.0f};   // unit, into the room
    float area = 0.0f;        // m^2, of the hole across the rays that leave through it
    glm::vec3 radiance{0.0f}; // RGB, 1 = the texture's white: mean of what lies behind it
};

/// A room taken apart: its lights, and a shading that every page can be divided by.
class RELAMP_API Decomposition
{
public:
    struct State;
    explicit Decomposition(std::unique_ptr<State> state);
    ~Decomposition();
    Decomposition(Decomposition&&) noexcept;
    Decomposition& operator=(Decomposition&&) noexcept;

    /// The scan that was taken apart, shared with whoever gave it.
    [[nodiscard]] const std::shared_ptr<const Scan>& scan() const;
    [[nodiscard]] const Lights& lights() const;
    /// The lights as few as they can be shown with: those closer than the merge distance are one.
    [[nodiscard]] const std::vector<PointLight>& mergedLights() const;
    /// By falling area. Of the thesis solver none are known.
    [[nodiscard]] const std::vector<Opening>& openings() const;
    /// The options, with all that was derived from the scan filled in. The engine, and what
    /// warnings() say of it, are those of now: one that nobody asked for may hand over to the CPU
    /// while it makes layers.
    [[nodiscard]] DelightOptions optionsInForce() const;
    [[nodiscard]] const Closure& closure() const;
    /// Of the thesis solver nothing is measured.
    [[nodiscard]] const CrossValidation& crossValidation() const;
    [[nodiscard]] std::vector<std::string> warnings() const;
    [[nodiscard]] size_t texelCount() const;
    [[nodiscard]] double area() const; // m^2 of textured surface

    /// Whose the texels of one page are, lamps that are off included.
    [[nodiscard]] FixtureMap fixtures(size_t page) const;
    /// How the light on the texels of one page was corrected; empty by solvers that don't.
    [[nodiscard]] CorrectionMap correction(size_t page) const;
    /// Where the texels of one page lie.
    [[nodiscard]] PageGeometry geometry(size_t page) const;

    /// Computes the layers of one page. Memory is a page's, whatever the size of the scan.
    [[nodiscard]] PageLayers layers(size_t page, Progress& progress = unwatched()) const;

    /// For relamp's own parts; its type is not public.
    [[nodiscard]] const State& state() const;

private:
    std::unique_ptr<State> state_;
};

/// Takes the light out of a scan, once; a Delighter does again and again. The result shares the
/// scan, which is not null.
///
/// Throws Error(unsupported) where too many texels of the scan stand for several places (see
/// ScanOptions::allowOverlap) or a
/// GPU is asked for that this solver has no use for, Error(device) where one is that is not there,
/// and Error(cancelled).
RELAMP_API Decomposition delight(std::shared_ptr<const Scan> scan,
                                 const DelightOptions& options = {},
                                 Progress& progress = unwatched());
/// The same of a scan that is handed over: `delight(readScan(file))`, `delight(std::move(scan))`.
RELAMP_API Decomposition delight(Scan&& scan, const DelightOptions& options = {},
                                 Progress& progress = unwatched());

} // namespace relamp
