#include "fit/lamps.h"

#include "base/call_all.h"
#include "base/parallel.h"
#include "base/radiometry.shared.h"
#include "fit/lamp_search.h"
#include "fit/light_gain.h"
#include "fit/outside.h"
#include "fit/sun.h"
#include "fit/sun_search.h"
#include "fit/unseen.h"
#include "lights/lamp_body.h"

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

constexpr double kNoiseOfPairs = 0.7; // of the median difference of pairs: half are of two paints
constexpr double kLeastNoise = 0.02;  // log; what a byte and a few rays tell
constexpr double kColorSpread = 1.0;  // log: of a lamp's channels about its luminance

// Numerics.
constexpr double kMostPieces =
    96.0; // of a room, that may emit; a fit takes the square of their number
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

} // namespace

LampSearch::LampSearch(const Texels& texels, const RayScene& scene, const HitLists& hits,
                       const SurfelRadiance& radiance, const GatherOptions& options, double rooms,
                       Progress& progress)
    : texels_(texels), scene_(scene), hits_(hits), isSunSought_(options.sun),
      isResponseSought_(!options.response && isByCamera(*texels.scan)),
      isGainSought_(options.gain && isByCamera(*texels.scan)),
      stage_(progress, "lamps", kSearchSteps),
      told_(toldPaintOf(options, texels.surfels, radiance, warnings_)), rooms_(rooms),
      evidence_(texels, scene, hits, radiance, options.quality, rooms, told_.same)
{
    if (options.response) takeResponse(*options.response);
    callAll([&] { takeCandidates(options, radiance); }, [&] { evidence_.drawAllPairs(); });
    const std::span<const uint8_t> ofPlaces = evidence_.roomOfPlace();
    const auto last = std::max_element(ofPlaces.begin(), ofPlaces.end());
    noise_.assign(last == ofPlaces.end() ? 1 : size_t{1} + *last, kFirstNoise);
}

void LampSearch::takeResponse(const Response& known)
{
    if (isByCamera(*texels_.scan))
        camera_.response = known;
    else if (!known.isStraight())
        warnings_.emplace_back("a texture is of floats, which are light by themselves: what was "
                               "said of the camera's response was passed over");
}

void LampSearch::takeCandidates(const GatherOptions& options, const SurfelRadiance& radiance)
{
    std::vector<Candidate> candidates = findCandidates(texels_, radiance);
    std::vector<uint8_t> isGiven(candidates.size() + 1, 0);
    std::vector<uint8_t> isRefused(candidates.size() + 1, 0);
    const auto mark = [&](glm::vec3 place, std::vector<uint8_t>& marks) {
        const size_t nearest = nearestTo(candidates, place);
        marks[nearest] = 1;
        if (nearest == candidates.size()) nothingNear_.push_back(place);
    };
    for (const glm::vec3 place : options.lights) mark(place, isGiven);
    for (const glm::vec3 place : options.notLights) mark(place, isRefused);
    isGiven.resize(candidates.size());
    size_t c = 0;
    std::erase_if(isGiven, [&](uint8_t) { return isRefused[c++] != 0; });
    c = 0;
    std::erase_if(candidates, [&](const Candidate&) { return isRefused[c++] != 0; });
    const auto most = static_cast<size_t>(kMostPieces * rooms_);
    LampGroups lamps = groupLamps(std::move(candidates), isGiven, most);
    if (lamps.leftOut > 0)
        warnings_.push_back(fmt::format("{} burnt-out pieces, {:.2f} m^2 together, are more than "
                                        "the {} largest and were taken for no lights; point at "
                                        "those that are with --light",
                                        lamps.leftOut, lamps.areaLeftOut, most));
    for (LampGroup& group : lamps.groups) addPieces(std::move(group), radiance);
    for (const Candidate& square : hits_.squares) {
        const size_t body = pieces_.size();
        pieces_.push_back({.candidate = square, .body = body, .isOpening = true});
    }
    emits_.assign(pieces_.size(), 1);
    evidence_.look(pieces_, 1);
    relatePieces();
    stage_.advance();
}

/// A group is flat and so has no far side.
void LampSearch::addPieces(LampGroup group, const SurfelRadiance& radiance)
{
    const size_t body = pieces_.size();
    const bool isFading = fades(texels_, radiance, group.whole);
    Piece piece{.candidate = std::move(group.whole),
                .ends = std::move(group.ends),
                .isGiven = group.isGiven,
                .body = body,
                .isFading = isFading};
    Candidate unseen;
    if (piece.ends.empty()) unseen = unseenSideOf(piece.candidate, texels_, scene_);
    pieces_.push_back(std::move(piece));
    if (unseen.patches.empty()) return;
    pieces_.push_back({.candidate = std::move(unseen), .body = body, .isUnseen = true});
}

/// What pieces are to each other; once for those that are there.
void LampSearch::relatePieces()
{
    sights_ = evidence_.sightsOf(pieces_);
    kin_ = kinshipOf(pieces_, scene_);
}

void LampSearch::observe()
{
    model_ = evidence_.modelOf(pieces_, sights_);
}

/// What decides which pieces emit, of a room's own.
std::vector<Choosable> LampSearch::choosable(std::span<const uint32_t> ofRoom) const
{
    std::vector<uint32_t> numbers(pieces_.size(), kNoPiece);
    for (uint32_t f = 0; f < ofRoom.size(); ++f) numbers[ofRoom[f]] = f;
    const auto here = [&](std::span<const uint32_t> pieces) {
        std::vector<uint32_t> some;
        for (const uint32_t f : pieces)
            if (numbers[f] != kNoPiece) some.push_back(numbers[f]);
        return some;
    };
    std::vector<Choosable> pieces;
    for (const uint32_t f : ofRoom)
        pieces.push_back({pieces_[f].isGiven, pieces_[f].isUnseen, pieces_[f].isOpening,
                          pieces_[f].isGiven ? 0.0 : natsOfSize(pieces_[f].candidate.area),
                          here(kin_.model[f]), here(kin_.leansOn[f]), here(kin_.takenFor[f])});
    return pieces;
}

/// Decides which pieces emit, from an estimate where more or fewer do; in every room by itself.
void LampSearch::choose(size_t pairs)
{
    const HouseLight house = houseLight(pairs);
    std::vector<ChosenLight> chosen(house.rooms().size());
    std::vector<LightEstimate> estimates(chosen.size());
    house.forEachRoom([&](size_t r, const RoomLight& room) {
        chosen[r] = chooseLamps(room.alone(camera_, !isResponseSought_), choosable(room.of.pieces));
        estimates[r] = std::move(chosen[r].estimate);
    });
    for (size_t r = 0; r < chosen.size(); ++r) {
        const std::vector<uint32_t>& pieces = house.rooms()[r].pieces;
        for (size_t f = 0; f < pieces.size(); ++f) emits_[pieces[f]] = chosen[r].emits[f];
    }
    estimate_ = house.joined(estimates);
}

std::vector<Piece> LampSearch::lamps() const
{
    std::vector<Piece> lamps;
    for (size_t f = 0; f < pieces_.size(); ++f)
        if (emits_[f] != 0 && !(sun_ && f == sun_->sun())) lamps.push_back(pieces_[f]);
    return lamps;
}

/// One ray an origin is noise, which makes the light of a lamp seem weaker than it is.
void LampSearch::lookCloser()
{
    std::vector<Piece> lamps = this->lamps();
    evidence_.look(lamps, LampEvidence::kMostRays);
    auto next = lamps.begin();
    for (size_t f = 0; f < pieces_.size(); ++f)
        if (emits_[f] != 0) pieces_[f] = std::move(*next++);
    observe();
}

/// One lamp of the pieces that are one; false where none are.
bool LampSearch::join()
{
    for (size_t f = 0; f < pieces_.size(); ++f) {
        pieces_[f].radiance = glm::vec3(static_cast<float>(std::exp(estimate_.log[f])));
        pieces_[f].error = static_cast<float>(estimate_.error[f]);
    }
    std::vector<Piece> lamps = this->lamps();
    const size_t before = lamps.size();
    joinPieces(lamps);
    const size_t count = lamps.size();
    if (count == before) return false;
    for (size_t f = 0; f < pieces_.size(); ++f)
        if (emits_[f] == 0 && !pieces_[f].isUnseen) lamps.push_back(std::move(pieces_[f]));
    pieces_ = std::move(lamps);
    emits_.assign(pieces_.size(), 0);
    std::fill_n(emits_.begin(), count, uint8_t{1});
    const std::vector<double> outside(estimate_.log.end() - static_cast<ptrdiff_t>(model_.outsides),
                                      estimate_.log.end());
    estimate_.log.clear();
    for (const Piece& piece : pieces_)
        estimate_.log.push_back(std::log(static_cast<double>(luminance(piece.radiance))));
    estimate_.log.insert(estimate_.log.end(), outside.begin(), outside.end());
    relatePieces();
    observe();
    return true;
}

/// What is believed to shine for another of its model, and lights nothing, is no lamp.
void LampSearch::dropFaint()
{
    std::vector<double> most(pieces_.size(), 0.0);
    const HouseLight house = houseLight(LampEvidence::kPairsFirst);
    house.forEachRoom([&](size_t, const RoomLight& room) {
        const std::vector<double> shares = room.shares();
        for (size_t f = 0; f < shares.size(); ++f) most[room.of.pieces[f]] = shares[f];
    });
    for (size_t f = 0; f < pieces_.size(); ++f)
        if (!pieces_[f].isGiven && most[f] < kLeastMatters) emits_[f] = 0;
}

/// A channel of the light, near its luminance.
LightEstimate LampSearch::colorOf(int channel) const
{
    const std::optional<LightModel> sunny =
        sun_ ? std::optional(sun_->channelOf(channel)) : std::nullopt;
    const HouseLight house = houseLight(LampEvidence::kPairs, sunny ? *sunny : model_);
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
        const HouseLight house = houseLight(LampEvidence::kPairs);
        estimate_ = house.joined(house.estimatesOf([](const RoomLight& room) {
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
            return rgb * static_cast<float>(std::exp(estimate_.log[f])) / luminance(rgb);
        };
        for (size_t f = 0; f < pieces_.size(); ++f) {
            pieces_[f].radiance = radianceOf(f);
            pieces_[f].error = static_cast<float>(estimate_.error[f]);
        }
        std::vector<glm::vec3> outside;
        for (size_t o = 0; o < model_.outsides; ++o)
            outside.push_back(radianceOf(pieces_.size() + o));
        outside_ = outsideOf(outside, hits_.shareOfPart);
        if (round > 0) return;
        std::vector<Piece> lamps = this->lamps();
        const LitSides sides = evidence_.settle(lamps, outside_);
        auto next = lamps.begin();
        for (size_t f = 0; f < pieces_.size(); ++f)
            if (emits_[f] != 0) pieces_[f] = std::move(*next++);
        model_ = evidence_.modelOf(pieces_, sights_, std::move(model_.direct));
        if (isSunSought_) letSunIn(sides);
        if (isGainSought_ && !sun_) findGain(); // a patch of sun is no drift
    }
}

/// A sun that is believed in is a piece like all others, and they are chosen again.
void LampSearch::letSunIn(const LitSides& sides)
{
    FoundLamps known;
    for (size_t f = 0; f < pieces_.size(); ++f)
        if (emits_[f] != 0) known.lamps.push_back({.patches = pieces_[f].candidate.patches});
    RayScene outside = sceneWithoutPanes(scene_, texels_, evidence_.radiance(), known);
    std::vector<uint32_t> all(pieces_.size());
    std::iota(all.begin(), all.end(), 0u);
    std::vector<double> cost;
    for (const Choosable& piece : choosable(all)) cost.push_back(natsToEmit(piece, emits_));
    std::optional<SunFit> fit =
        findSun(texels_, outside, hits_, evidence_.radiance(),
                {sides, pieces_, emits_, cost, estimate_.log, model_, evidence_.places(),
                 evidence_.pairs(LampEvidence::kPairsFirst), kin_.alike, evidence_.told(),
                 noiseOfAll(), natsOfLamp()});
    if (!fit) return;
    for (const size_t perPlace : {LampEvidence::kPairsFirst, LampEvidence::kPairs})
        evidence_.addPairs(perPlace, fit->trial.pairs(evidence_.pairs(perPlace).size()));
    beforeSun_ = std::move(outside);
    sun_ = std::move(fit->trial);
    model_ = sun_->with;
    emits_ = std::move(fit->emits);
    estimate_ = std::move(fit->estimate);
    pieces_.push_back({.isGiven = true, .body = pieces_.size()});
    kin_.model.emplace_back();
    kin_.leansOn.emplace_back();
    kin_.takenFor.emplace_back();
    choose(LampEvidence::kPairsFirst);
}

/// The sun goes from the pieces into what is found, and burnt-out patches of it come behind lamps.
void LampSearch::takeSun(FoundLamps& found)
{
    if (!sun_) return;
    const Piece& sun = pieces_[sun_->sun()];
    found.sun = {.sun = {.direction = sun_->towards,
                         .irradiance = sun.radiance * sunSolidAngle(),
                         .error = glm::vec3(sun.error),
                         .determined = isDetermined(sun.error)},
                 .outside = *std::move(beforeSun_),
                 .onSides = std::move(sun_->onSides)};
    for (const SunPatch& patch : sun_->patches) {
        found.lamps.push_back(
            {.patches = std::move(pieces_[patch.piece].candidate.patches), .isSunlit = true});
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
    std::vector<float> change(evidence_.places().size(), 0.0f);
    const HouseLight house = houseLight(LampEvidence::kPairsFirst);
    house.forEachRoom([&](size_t r, const RoomLight& room) {
        CameraModel camera{.response = camera_.response};
        if (!camera_.gains.empty()) camera.gains = {camera_.gains[r]};
        const std::vector<float> ofRoom =
            relamp::changeUnseen(room.alone(camera, !isResponseSought_), texels_.surfels.seed);
        for (size_t i = 0; i < ofRoom.size(); ++i) change[room.of.places[i]] = ofRoom[i];
    });
    return change;
}

/// How likely the mesh lets light in, by what places of one paint differ by in the dark.
float LampSearch::gaps() const
{
    const HouseLight house = houseLight(LampEvidence::kPairsFirst);
    std::vector<double> ofRooms(house.rooms().size());
    house.forEachRoom(
        [&](size_t r, const RoomLight& room) { ofRooms[r] = room.fit().gaps(room.log); });
    double gaps = 0.0;
    for (size_t r = 0; r < ofRooms.size(); ++r) gaps += shareOf(house.rooms()[r]) * ofRooms[r];
    return static_cast<float>(std::min(gaps, 1.0));
}

FoundLamps LampSearch::result()
{
    FoundLamps found{.powers = {.lamps = {}, .outside = outside_},
                     .residual = static_cast<float>(estimate_.residual),
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
    found.camera = std::move(camera_);
    found.doubtOfResponse = doubtOfResponse_;
    stage_.advance();
    return found;
}

double LampSearch::noiseOfAll() const
{
    return std::accumulate(noise_.begin(), noise_.end(), 0.0) / static_cast<double>(noise_.size());
}

/// The light of all rooms, and how noisy their pairs are in it.
void LampSearch::solve(const std::function<LightEstimate(const RoomLight&)>& estimateOf)
{
    const HouseLight house = houseLight(LampEvidence::kPairsFirst);
    const std::vector<LightEstimate> estimates = house.estimatesOf(estimateOf);
    estimate_ = house.joined(estimates);
    for (size_t r = 0; r < estimates.size(); ++r)
        noise_[r] = std::max(kNoiseOfPairs * estimates[r].residual, kLeastNoise);
}

FoundLamps LampSearch::run()
{
    if (!evidence_.tells())
        return {.white = std::move(told_.white), .warnings = std::move(warnings_)};
    if (!camera_.isNeutral()) evidence_.linearize(camera_);
    observe();
    estimate_.log.assign(model_.pieces + model_.outsides, 0.0); // of other rooms, to begin with
    solve([](const RoomLight& room) {
        const LightFit fit = room.fit();
        return fit.solve(room.emits, fit.beginning(), kFirstWidth);
    });
    findContrast();
    choose(LampEvidence::kPairsFirst);
    stage_.advance();
    lookCloser();
    choose(LampEvidence::kPairsFirst);
    if (isBent()) {
        bend(LampEvidence::kPairs);
        choose(LampEvidence::kPairsFirst);
    }
    for (int round = 0; round < kJoins && join(); ++round) choose(LampEvidence::kPairsFirst);
    stage_.advance();
    findColors();
    return result();
}

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
