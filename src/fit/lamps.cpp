#include "fit/lamps.h"

#include "base/call_all.h"
#include "base/parallel.h"
#include "base/radiometry.shared.h"
#include "fit/camera_search.h"
#include "fit/lamp_choice.h"
#include "fit/lamp_pieces.h"
#include "fit/light_gain.h"
#include "fit/outside.h"
#include "fit/searched_light.h"
#include "fit/sun.h"
#include "fit/sun_search.h"
#include "fit/sun_trial.h"
#include "fit/told_paint.h"
#include "fit/unseen.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace relamp
{
namespace
{

constexpr double kColorSpread = 1.0; // log: of a lamp's channels about its luminance

// Numerics.
constexpr size_t kSearchSteps = 4; // of the search, as progress tells
constexpr int kJoins = 4;          // rounds, at most
constexpr uint32_t kNoPiece = ~0u; // a number that none has

std::string unknownAt(glm::vec3 place, size_t lamps)
{
    if (lamps > 1)
        return fmt::format("the scan does not tell how bright the {} lights around {:.2f}, {:.2f}, "
                           "{:.2f} are, for they light little that can be seen; their radiance is "
                           "a guess. Set it in lights.json and pass that with --lights",
                           lamps, place.x, place.y, place.z);
    return fmt::format("the scan does not tell how bright the light at {:.2f}, {:.2f}, {:.2f} is, "
                       "for it lights little that can be seen; its radiance is a guess. Set it in "
                       "lights.json and pass that with --lights",
                       place.x, place.y, place.z);
}

/// Whether a standard error of log radiance is less than a factor of two.
bool isDetermined(float error)
{
    return static_cast<double>(error) < std::numbers::ln2;
}

/// Whether the textures are pictures of a camera; floats are light by themselves.
bool isByCamera(const Scan& scan)
{
    return std::all_of(scan.pages.begin(), scan.pages.end(),
                       [](const Page& page) { return page.image.clipsAtWhite; });
}

/// One search: findLamps().
class LampSearch
{
public:
    LampSearch(const Texels& texels, const RayScene& scene, const HitLists& hits,
               const SurfelRadiance& radiance, const GatherOptions& options, double rooms,
               Progress& progress);

    FoundLamps run();

private:
    void takeResponse(const Response& known);
    [[nodiscard]] std::vector<Choosable> choosable(std::span<const uint32_t> ofRoom) const;
    void choose(size_t pairs);
    [[nodiscard]] std::vector<Piece> lamps() const;
    void putBack(std::vector<Piece> lamps);
    void lookCloser();
    bool join();
    void dropFaint();
    [[nodiscard]] LightEstimate colorOf(int channel) const;
    void findColors();
    void letSunIn(const LitSides& sides);
    void takeSun(FoundLamps& found);
    [[nodiscard]] std::vector<float> changeUnseen() const;
    [[nodiscard]] float gaps() const;
    FoundLamps result();

    const Texels& texels_;
    const RayScene& scene_;
    const HitLists& hits_;
    bool isSunSought_;
    Progress::Stage stage_;
    std::vector<glm::vec3> nothingNear_; // see FoundLamps
    std::vector<std::string> warnings_;
    ToldPaint told_; // of surfels
    SearchedLight light_;
    CameraSearch camera_;
    std::optional<RayScene> beforeSun_; // what stands before it
    std::optional<SunTrial> sun_;       // the last piece
};

LampSearch::LampSearch(const Texels& texels, const RayScene& scene, const HitLists& hits,
                       const SurfelRadiance& radiance, const GatherOptions& options, double rooms,
                       Progress& progress)
    : texels_(texels), scene_(scene), hits_(hits), isSunSought_(options.sun),
      stage_(progress, "lamps", kSearchSteps),
      told_(toldPaintOf(options, texels.surfels, radiance, warnings_)),
      light_{.evidence =
                 LampEvidence(texels, scene, hits, radiance, options.quality, rooms, told_.same),
             .isResponseKnown = options.response || !isByCamera(*texels.scan)},
      camera_(light_, !light_.isResponseKnown, options.gain && isByCamera(*texels.scan))
{
    if (options.response) takeResponse(*options.response);
    LampPieces found;
    callAll([&] { found = lampPiecesOf(texels, scene, hits, radiance, options, rooms); },
            [&] { light_.evidence.drawAllPairs(); });
    light_.pieces = std::move(found.pieces);
    nothingNear_ = std::move(found.nothingNear);
    std::ranges::move(found.warnings, std::back_inserter(warnings_));
    light_.emits.assign(light_.pieces.size(), 1);
    light_.evidence.look(light_.pieces, 1);
    light_.relate(scene);
    stage_.advance();
}

void LampSearch::takeResponse(const Response& known)
{
    if (isByCamera(*texels_.scan))
        light_.camera.response = known;
    else if (!known.isStraight())
        warnings_.emplace_back("a texture is of floats, which are light by themselves: what was "
                               "said of the camera's response was passed over");
}

/// What decides which pieces emit, of a room's own.
std::vector<Choosable> LampSearch::choosable(std::span<const uint32_t> ofRoom) const
{
    std::vector<uint32_t> numbers(light_.pieces.size(), kNoPiece);
    for (uint32_t f = 0; f < ofRoom.size(); ++f) numbers[ofRoom[f]] = f;
    const auto here = [&](std::span<const uint32_t> pieces) {
        std::vector<uint32_t> some;
        for (const uint32_t f : pieces)
            if (numbers[f] != kNoPiece) some.push_back(numbers[f]);
        return some;
    };
    std::vector<Choosable> pieces;
    for (const uint32_t f : ofRoom)
        pieces.push_back(
            {light_.pieces[f].isGiven, light_.pieces[f].isUnseen, light_.pieces[f].isOpening,
             light_.pieces[f].isGiven ? 0.0 : natsOfSize(light_.pieces[f].candidate.area),
             here(light_.kin.model[f]), here(light_.kin.leansOn[f])});
    return pieces;
}

/// Decides which pieces emit, from an estimate where more or fewer do; in every room by itself.
void LampSearch::choose(size_t pairs)
{
    const HouseLight house = light_.house(pairs);
    std::vector<ChosenLight> chosen(house.rooms().size());
    std::vector<LightEstimate> estimates(chosen.size());
    house.forEachRoom([&](size_t r, const RoomLight& room) {
        chosen[r] =
            chooseLamps(room.alone(light_.camera, light_.isResponseKnown),
                        choosable(room.of.pieces), sun_ ? CameraColumns{} : camera_.driftOf(room));
        estimates[r] = std::move(chosen[r].estimate);
    });
    for (size_t r = 0; r < chosen.size(); ++r) {
        const std::vector<uint32_t>& pieces = house.rooms()[r].pieces;
        for (size_t f = 0; f < pieces.size(); ++f) light_.emits[pieces[f]] = chosen[r].emits[f];
    }
    light_.estimate = house.joined(estimates);
}

std::vector<Piece> LampSearch::lamps() const
{
    std::vector<Piece> lamps;
    for (size_t f = 0; f < light_.pieces.size(); ++f)
        if (light_.emits[f] != 0 && !(sun_ && f == sun_->sun())) lamps.push_back(light_.pieces[f]);
    return lamps;
}

/// The same in their places.
void LampSearch::putBack(std::vector<Piece> lamps)
{
    auto next = lamps.begin();
    for (size_t f = 0; f < light_.pieces.size(); ++f)
        if (light_.emits[f] != 0) light_.pieces[f] = std::move(*next++);
}

/// One ray an origin is noise, which makes the light of a lamp seem weaker than it is.
void LampSearch::lookCloser()
{
    std::vector<Piece> lamps = this->lamps();
    light_.evidence.look(lamps, LampEvidence::kMostRays);
    putBack(std::move(lamps));
    light_.observe();
}

/// One lamp of the pieces that are one; false where none are.
bool LampSearch::join()
{
    for (size_t f = 0; f < light_.pieces.size(); ++f) {
        light_.pieces[f].radiance = glm::vec3(static_cast<float>(std::exp(light_.estimate.log[f])));
        light_.pieces[f].error = static_cast<float>(light_.estimate.error[f]);
    }
    std::vector<Piece> lamps = this->lamps();
    const size_t before = lamps.size();
    joinPieces(lamps);
    const size_t count = lamps.size();
    if (count == before) return false;
    for (size_t f = 0; f < light_.pieces.size(); ++f)
        if (light_.emits[f] == 0 && !light_.pieces[f].isUnseen)
            lamps.push_back(std::move(light_.pieces[f]));
    light_.pieces = std::move(lamps);
    light_.emits.assign(light_.pieces.size(), 0);
    std::fill_n(light_.emits.begin(), count, uint8_t{1});
    const std::vector<double> outside(light_.estimate.log.end() -
                                          static_cast<ptrdiff_t>(light_.model.outsides),
                                      light_.estimate.log.end());
    light_.estimate.log.clear();
    for (const Piece& piece : light_.pieces)
        light_.estimate.log.push_back(std::log(static_cast<double>(luminance(piece.radiance))));
    light_.estimate.log.insert(light_.estimate.log.end(), outside.begin(), outside.end());
    light_.relate(scene_);
    light_.observe();
    return true;
}

/// What is believed to shine for another of its model, and lights nothing, is no lamp.
void LampSearch::dropFaint()
{
    std::vector<double> most(light_.pieces.size(), 0.0);
    const HouseLight house = light_.house(LampEvidence::kPairsFirst);
    house.forEachRoom([&](size_t, const RoomLight& room) {
        const std::vector<double> shares = room.shares();
        for (size_t f = 0; f < shares.size(); ++f) most[room.of.pieces[f]] = shares[f];
    });
    for (size_t f = 0; f < light_.pieces.size(); ++f)
        if (!light_.pieces[f].isGiven && most[f] < kLeastMatters) light_.emits[f] = 0;
}

/// A channel of the light, near its luminance.
LightEstimate LampSearch::colorOf(int channel) const
{
    const std::optional<LightModel> sunny =
        sun_ ? std::optional(sun_->channelOf(channel)) : std::nullopt;
    const HouseLight house = light_.house(LampEvidence::kPairs, sunny ? *sunny : light_.model);
    return house.joined(house.estimatesOf([&](const RoomLight& room) {
        LightFit fit = room.fit(channel);
        fit.expectLeaks(room.log);
        return fit.solve(room.emits, room.log, kFirstWidth, {room.log, kColorSpread});
    }));
}

/// Each channel by itself, near the luminance; burnt-out walls and backs settle in that light, and
/// once more.
void LampSearch::findColors()
{
    for (int round = 0; round < 2; ++round) {
        const HouseLight house = light_.house(LampEvidence::kPairs);
        light_.estimate = house.joined(house.estimatesOf([](const RoomLight& room) {
            LightFit fit = room.fit();
            fit.expectLeaks(room.log);
            return fit.solve(room.emits, room.log, 1.0);
        }));
        dropFaint();
        std::array<LightEstimate, 3> colors;
        forEach(3, [&](size_t c) { colors[c] = colorOf(static_cast<int>(c)); });
        const auto radianceOf = [&](size_t f) {
            glm::vec3 rgb;
            for (size_t c = 0; c < 3; ++c)
                rgb[static_cast<int>(c)] = static_cast<float>(std::exp(colors[c].log[f]));
            return rgb * static_cast<float>(std::exp(light_.estimate.log[f])) / luminance(rgb);
        };
        for (size_t f = 0; f < light_.pieces.size(); ++f) {
            light_.pieces[f].radiance = radianceOf(f);
            light_.pieces[f].error = static_cast<float>(light_.estimate.error[f]);
        }
        std::vector<glm::vec3> outside;
        for (size_t o = 0; o < light_.model.outsides; ++o)
            outside.push_back(radianceOf(light_.pieces.size() + o));
        light_.outside = outsideOf(outside, hits_.shareOfPart);
        if (round > 0) return;
        std::vector<Piece> lamps = this->lamps();
        const LitSides sides = light_.evidence.settle(lamps, light_.outside);
        putBack(std::move(lamps));
        light_.gatherAnew();
        if (isSunSought_) letSunIn(sides);
        if (!sun_) camera_.findGain(); // a patch of sun is no drift
    }
}

/// A sun that is believed in is a piece like all others, and they are chosen again.
void LampSearch::letSunIn(const LitSides& sides)
{
    FoundLamps known;
    for (size_t f = 0; f < light_.pieces.size(); ++f)
        if (light_.emits[f] != 0)
            known.lamps.push_back({.patches = light_.pieces[f].candidate.patches});
    RayScene outside = sceneWithoutPanes(scene_, texels_, light_.evidence.radiance(), known);
    std::vector<uint32_t> all(light_.pieces.size());
    std::iota(all.begin(), all.end(), 0u);
    std::vector<double> cost;
    for (const Choosable& piece : choosable(all)) cost.push_back(natsToEmit(piece, light_.emits));
    std::optional<SunFit> fit =
        findSun(texels_, outside, hits_, light_.evidence.radiance(),
                {sides, light_.pieces, light_.emits, cost, light_.estimate.log, light_.model,
                 light_.evidence.places(), light_.evidence.pairs(LampEvidence::kPairsFirst),
                 light_.kin.alike, light_.evidence.told(), light_.noiseOfAll(), natsOfLamp()});
    if (!fit) return;
    for (const size_t perPlace : {LampEvidence::kPairsFirst, LampEvidence::kPairs})
        light_.evidence.addPairs(perPlace,
                                 fit->trial.pairs(light_.evidence.pairs(perPlace).size()));
    beforeSun_ = std::move(outside);
    sun_ = std::move(fit->trial);
    light_.model = sun_->with;
    light_.emits = std::move(fit->emits);
    light_.estimate = std::move(fit->estimate);
    light_.add({.isGiven = true, .body = light_.pieces.size()});
    choose(LampEvidence::kPairsFirst);
}

/// The sun goes from the pieces into what is found, and burnt-out patches of it come behind lamps.
void LampSearch::takeSun(FoundLamps& found)
{
    if (!sun_) return;
    const Piece& sun = light_.pieces[sun_->sun()];
    found.sun = {.sun = {.direction = sun_->towards,
                         .irradiance = sun.radiance * sunSolidAngle(),
                         .error = glm::vec3(sun.error),
                         .determined = isDetermined(sun.error)},
                 .outside = *std::move(beforeSun_),
                 .onSides = std::move(sun_->onSides)};
    for (const SunPatch& patch : sun_->patches) {
        found.lamps.push_back(
            {.patches = std::move(light_.pieces[patch.piece].candidate.patches), .isSunlit = true});
        found.powers.lamps.push_back(patch.perRadiance * sun.radiance);
    }
}

/// Of log power: what the light of a lamp leaves open, and its area.
float errorOfPower(const Piece& lamp)
{
    return std::hypot(lamp.error, errorOfArea(lamp.candidate.area));
}

/// In every room by itself.
std::vector<float> LampSearch::changeUnseen() const
{
    std::vector<float> change(light_.evidence.places().size(), 0.0f);
    const HouseLight house = light_.house(LampEvidence::kPairsFirst);
    house.forEachRoom([&](size_t r, const RoomLight& room) {
        CameraModel camera{.response = light_.camera.response};
        if (!light_.camera.gains.empty()) camera.gains = {light_.camera.gains[r]};
        const std::vector<float> ofRoom =
            relamp::changeUnseen(room.alone(camera, light_.isResponseKnown), texels_.surfels.seed);
        for (size_t i = 0; i < ofRoom.size(); ++i) change[room.of.places[i]] = ofRoom[i];
    });
    return change;
}

/// How likely the mesh lets light in, by what places of one paint differ by in the dark.
float LampSearch::gaps() const
{
    const HouseLight house = light_.house(LampEvidence::kPairsFirst);
    std::vector<double> ofRooms(house.rooms().size());
    house.forEachRoom(
        [&](size_t r, const RoomLight& room) { ofRooms[r] = room.fit().gaps(room.log); });
    double gaps = 0.0;
    for (size_t r = 0; r < ofRooms.size(); ++r)
        gaps += light_.shareOf(house.rooms()[r]) * ofRooms[r];
    return static_cast<float>(std::min(gaps, 1.0));
}

FoundLamps LampSearch::result()
{
    FoundLamps found{.powers = {.lamps = {}, .outside = light_.outside},
                     .residual = static_cast<float>(light_.estimate.residual),
                     .gaps = gaps(),
                     .changeUnseen = changeUnseen(),
                     .white = std::move(told_.white),
                     .nothingNear = std::move(nothingNear_),
                     .warnings = std::move(warnings_)};
    std::vector<Piece> lamps = this->lamps();
    const auto power = [](const Piece& lamp) {
        return lamp.candidate.area * luminance(lamp.radiance);
    };
    std::stable_sort(lamps.begin(), lamps.end(),
                     [&](const Piece& a, const Piece& b) { return power(a) > power(b); });
    for (Piece& lamp : lamps) {
        const bool isTold = isDetermined(lamp.error);
        if (!isTold) found.warnings.push_back(unknownAt(lamp.candidate.centre, lamp.ends.size()));
        found.lamps.push_back({std::move(lamp.candidate.patches), glm::vec3(errorOfPower(lamp)),
                               std::move(lamp.onSides), false, isTold, std::move(lamp.ends)});
        found.powers.lamps.push_back(lamp.radiance);
    }
    takeSun(found);
    found.camera = std::move(light_.camera);
    found.doubtOfResponse = camera_.doubt();
    stage_.advance();
    return found;
}

FoundLamps LampSearch::run()
{
    if (!light_.evidence.tells())
        return {.white = std::move(told_.white), .warnings = std::move(warnings_)};
    if (!light_.camera.isNeutral()) light_.evidence.linearize(light_.camera);
    light_.begin();
    camera_.findContrast();
    camera_.expectDrift();
    choose(LampEvidence::kPairsFirst);
    stage_.advance();
    lookCloser();
    choose(LampEvidence::kPairsFirst);
    if (camera_.isBent()) {
        camera_.bend(LampEvidence::kPairs);
        choose(LampEvidence::kPairsFirst);
    }
    for (int round = 0; round < kJoins && join(); ++round) choose(LampEvidence::kPairsFirst);
    stage_.advance();
    findColors();
    return result();
}

} // namespace

FoundLamps findLamps(const Texels& texels, const RayScene& scene, const HitLists& hits,
                     const SurfelRadiance& radiance, const GatherOptions& options, double rooms,
                     Progress& progress)
{
    return LampSearch(texels, scene, hits, radiance, options, rooms, progress).run();
}

std::vector<std::span<const ClippedPatch>> singlesOf(const FoundLamp& lamp)
{
    if (lamp.ends.empty()) return {lamp.patches};
    std::vector<std::span<const ClippedPatch>> singles;
    uint32_t begin = 0;
    for (const uint32_t end : lamp.ends) {
        singles.push_back(std::span(lamp.patches).subspan(begin, end - begin));
        begin = end;
    }
    return singles;
}

} // namespace relamp
