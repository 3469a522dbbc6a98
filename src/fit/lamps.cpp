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
#include <memory>
#include <numeric>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace relamp
{
namespace
{

// That it takes to believe in a lamp: log odds of one piece in seven. Narrow: at 2 the sample at
// 0.7 of its exposure loses its table lamp, at 1.7 a reconstructed workshop gains one of 5 cm^2.
constexpr double kLampNats = 1.85;
// Where one of its model emits: the log odds in rooms with ground truth, where 357 of 361 pieces
// that looked like a lamp were one.
constexpr double kModelNats = -4.0;
constexpr double kNoiseOfPairs = 0.7; // of the median difference of pairs: half are of two paints
constexpr double kLeastNoise = 0.02;  // log; what a byte and a few rays tell
constexpr double kUnknown = 0.7;      // standard error of log radiance: about a factor of two
constexpr double kColorSpread = 1.0;  // log: of a lamp's channels about its luminance

// Numerics.
constexpr double kLeanNats = 0.03; // a part of a lamp that no light asks for does not shine
constexpr double kMostPieces =
    96.0; // of a room, that may emit; a fit takes the square of their number
constexpr size_t kSearchSteps = 4; // of the search, as progress tells
constexpr double kTries = 4.0;     // of the most promising pieces of a room, each time one is added
constexpr float kHardlyCommon = 0.01f; // of two lamps' light at places, that comes to the same ones
constexpr int kChoices = 4;            // rounds of taking away and adding, at most

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
      evidence_(texels, scene, hits, radiance, options.quality, rooms, told_.same),
      noise_(kFirstNoise)
{
    if (options.response) takeResponse(*options.response);
    callAll([&] { takeCandidates(options, radiance); }, [&] { evidence_.drawAllPairs(); });
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
    for (LampGroup& group : lamps.groups) addPieces(std::move(group));
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
void LampSearch::addPieces(LampGroup group)
{
    const size_t body = pieces_.size();
    Piece piece{.candidate = std::move(group.whole),
                .ends = std::move(group.ends),
                .isGiven = group.isGiven,
                .body = body};
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

LightFit LampSearch::fitOf(size_t pairs) const
{
    LightFit fit(model_, evidence_.pairs(pairs), kin_.alike, noise_);
    fit.believe(evidence_.told());
    return fit;
}

/// Nats that it takes to believe that a piece emits; none where one does that it is a part of. One
/// of its model that emits speaks for it.
double LampSearch::costOf(uint32_t piece) const
{
    const auto emits = [&](uint32_t other) { return emits_[other] != 0; };
    const auto anyOf = [&](const std::vector<uint32_t>& others) {
        return std::any_of(others.begin(), others.end(), emits);
    };
    if (anyOf(kin_.leansOn[piece])) return kLeanNats;
    return anyOf(kin_.model[piece]) ? kModelNats : kLampNats;
}

/// These with all that leans on nothing else.
Removal LampSearch::removalOf(std::vector<uint32_t> pieces, double cost) const
{
    std::vector<uint8_t> isGone(pieces_.size(), 0);
    for (const uint32_t piece : pieces) isGone[piece] = 1;
    Removal removal{std::move(pieces), cost};
    for (size_t k = 0; k < removal.pieces.size(); ++k)
        for (uint32_t f = 0; f < pieces_.size(); ++f) {
            if (emits_[f] == 0 || isGone[f] != 0 || pieces_[f].isGiven) continue;
            const std::vector<uint32_t>& on = kin_.leansOn[f];
            const auto isLeft = [&](uint32_t other) {
                return emits_[other] != 0 && isGone[other] == 0;
            };
            if (std::find(on.begin(), on.end(), removal.pieces[k]) == on.end() ||
                std::any_of(on.begin(), on.end(), isLeft))
                continue;
            isGone[f] = 1;
            removal.pieces.push_back(f);
        }
    return removal;
}

/// Every piece that emits by itself, and those of one model together: each of ten panels is hardly
/// missed where nine are left.
std::vector<Removal> LampSearch::removals() const
{
    std::vector<Removal> removals;
    const auto mayGo = [&](uint32_t f) { return emits_[f] != 0 && !pieces_[f].isGiven; };
    for (uint32_t f = 0; f < pieces_.size(); ++f) {
        if (!mayGo(f)) continue;
        removals.push_back(removalOf({f}, costOf(f)));
        std::vector<uint32_t> model{f};
        std::copy_if(kin_.model[f].begin(), kin_.model[f].end(), std::back_inserter(model), mayGo);
        if (model.size() > 1) removals.push_back(removalOf(std::move(model), kLampNats));
    }
    return removals;
}

/// Lets no piece emit that the rest explains, as far as the cost's quadratic form tells.
void LampSearch::prune(const LightFit& fit)
{
    for (;;) {
        const std::vector<Removal> removals = this->removals();
        const std::vector<uint8_t> gone = fit.needless(estimate_, emits_, removals);
        if (std::all_of(gone.begin(), gone.end(), [](uint8_t g) { return g == 0; })) return;
        for (size_t k = 0; k < removals.size(); ++k)
            if (gone[k] != 0)
                for (const uint32_t piece : removals[k].pieces) emits_[piece] = 0;
        estimate_ = fit.solve(emits_, estimate_.log, 1.0);
    }
}

/// Which sets of pieces can be decided on at once, from the first on: each lights hardly a place
/// that one before it lights, as lamps of two rooms do.
std::vector<size_t> LampSearch::apart(std::span<const std::vector<uint32_t>> sets) const
{
    std::vector<size_t> apart;
    std::vector<std::vector<float>> lights;
    for (size_t k = 0; k < sets.size(); ++k) {
        std::vector<float> light(model_.places(), 0.0f);
        for (size_t i = 0; i < light.size(); ++i)
            for (const uint32_t piece : sets[k]) light[i] += model_.directAt(i)[piece];
        const float all = std::accumulate(light.begin(), light.end(), 0.0f);
        for (float& l : light) l /= std::max(all, kFaintest);
        const auto isApart = [&](const std::vector<float>& other) {
            float common = 0.0f;
            for (size_t i = 0; i < light.size(); ++i) common += std::min(light[i], other[i]);
            return common < kHardlyCommon;
        };
        if (!std::all_of(lights.begin(), lights.end(), isApart)) continue;
        apart.push_back(k);
        lights.push_back(std::move(light));
    }
    return apart;
}

/// The same by fits without each of them; the least needed goes first, and with it what is apart
/// from it.
void LampSearch::drop(const LightFit& fit)
{
    struct Trial
    {
        std::vector<uint8_t> emits;
        LightEstimate estimate{};
        double lost = 0.0; // nats
    };
    for (;;) {
        std::vector<Removal> removals = this->removals();
        std::vector<Trial> trials(removals.size());
        forEach(trials.size(), [&](size_t k) {
            trials[k].emits = emits_;
            for (const uint32_t piece : removals[k].pieces) trials[k].emits[piece] = 0;
            const double most = estimate_.nats + removals[k].cost;
            trials[k].estimate = fit.trial(trials[k].emits, estimate_.log, most);
            trials[k].lost = trials[k].estimate.nats - most;
        });
        std::vector<size_t> needless;
        for (size_t k = 0; k < trials.size(); ++k)
            if (trials[k].lost < 0.0) needless.push_back(k);
        if (needless.empty()) return;
        std::stable_sort(needless.begin(), needless.end(),
                         [&](size_t a, size_t b) { return trials[a].lost < trials[b].lost; });
        std::vector<std::vector<uint32_t>> sets;
        for (const size_t k : needless) sets.push_back(std::move(removals[k].pieces));
        const std::vector<size_t> gone = apart(sets);
        for (const size_t set : gone)
            for (const uint32_t piece : sets[set]) emits_[piece] = 0;
        estimate_ = gone.size() == 1 ? std::move(trials[needless.front()].estimate)
                                     : fit.trial(emits_, estimate_.log, INFINITY);
    }
}

/// The pieces whose emission gains most, apart from each other; none where nothing gains.
std::vector<LampSearch::Addition> LampSearch::bestAdditions(const LightFit& fit) const
{
    std::vector<Addition> additions;
    for (uint32_t f = 0; f < pieces_.size(); ++f)
        if (emits_[f] == 0 && !pieces_[f].isUnseen &&
            (pieces_[f].isOpening || model_.area[f] > 0.0f))
            additions.push_back({f});
    const LightGain gain(fit, estimate_);
    forEach(additions.size(), [&](size_t k) {
        Addition& a = additions[k];
        a.gain = gain.of(a.piece, a.log) - costOf(a.piece);
    });
    const auto sort = [&] {
        std::stable_sort(additions.begin(), additions.end(),
                         [](const Addition& a, const Addition& b) { return a.gain > b.gain; });
    };
    sort();
    std::erase_if(additions, [](const Addition& a) { return a.log <= 0.0; });
    additions.resize(std::min(additions.size(), static_cast<size_t>(kTries * rooms_)));
    forEach(additions.size(), [&](size_t k) {
        Addition& a = additions[k];
        std::vector<uint8_t> with = emits_;
        with[a.piece] = 1;
        std::vector<double> start = estimate_.log;
        start[a.piece] = a.log;
        const double most = estimate_.nats - costOf(a.piece);
        a.estimate = fit.trial(with, std::move(start), most);
        a.gain = most - a.estimate.nats;
    });
    std::erase_if(additions, [](const Addition& a) { return a.gain <= 0.0; });
    sort();
    std::vector<std::vector<uint32_t>> sets;
    for (const Addition& a : additions) sets.push_back({a.piece});
    std::vector<Addition> best;
    for (const size_t set : apart(sets)) best.push_back(std::move(additions[set]));
    return best;
}

/// Lets the pieces emit that the light of the room asks for most, again and again; false where none
/// is asked for.
bool LampSearch::grow(const LightFit& fit)
{
    for (bool isAny = false;; isAny = true) {
        std::vector<Addition> best = bestAdditions(fit);
        if (best.empty()) return isAny;
        std::vector<double> start = estimate_.log;
        for (const Addition& a : best) {
            emits_[a.piece] = 1;
            start[a.piece] = a.log;
        }
        estimate_ = best.size() == 1 ? std::move(best.front().estimate)
                                     : fit.trial(emits_, std::move(start), INFINITY);
    }
}

/// Decides which pieces emit, from an estimate where more or fewer do.
void LampSearch::choose(size_t pairs)
{
    LightFit fit = fitOf(pairs);
    fit.expectLeaks(estimate_.log);
    estimate_ = fit.solve(emits_, estimate_.log, 1.0);
    prune(fit);
    for (int round = 0; round < kChoices; ++round) {
        drop(fit);
        if (!grow(fit)) break;
    }
    if (estimate_.error.empty()) estimate_ = fit.solve(emits_, estimate_.log, 1.0);
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

/// Each channel by itself, near the luminance; burnt-out walls and backs settle in that light, and
/// once more.
void LampSearch::findColors()
{
    for (int round = 0; round < 2; ++round) {
        LightFit fit = fitOf(LampEvidence::kPairs);
        fit.expectLeaks(estimate_.log);
        estimate_ = fit.solve(emits_, estimate_.log, 1.0);
        std::array<LightEstimate, 3> colors;
        forEach(3, [&](size_t c) {
            const std::optional<LightModel> sunny =
                sun_ ? std::optional(sun_->channelOf(static_cast<int>(c))) : std::nullopt;
            LightFit channel(sunny ? *sunny : model_, evidence_.pairs(LampEvidence::kPairs),
                             kin_.alike, noise_, static_cast<int>(c));
            channel.believe(evidence_.told());
            channel.expectLeaks(estimate_.log);
            colors[c] =
                channel.solve(emits_, estimate_.log, kFirstWidth, {estimate_.log, kColorSpread});
        });
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
        observe();
        if (isSunSought_) letSunIn(sides);
        if (isGainSought_ && !sun_) findGain(); // a patch of sun is no drift
    }
}

/// A sun that is believed in is a piece like all others, and they are chosen again.
void LampSearch::letSunIn(const LitSides& sides)
{
    FoundLamps known;
    for (const Piece& piece : lamps()) known.lamps.push_back({.patches = piece.candidate.patches});
    auto outside =
        std::make_shared<const RayScene>(sceneWithoutPanes(texels_, evidence_.radiance(), known));
    std::vector<double> cost;
    for (uint32_t f = 0; f < pieces_.size(); ++f) cost.push_back(costOf(f));
    std::optional<SunFit> fit =
        findSun(texels_, *outside, hits_, evidence_.radiance(),
                {sides, pieces_, emits_, cost, estimate_.log, model_, evidence_.places(),
                 evidence_.pairs(LampEvidence::kPairsFirst), kin_.alike, evidence_.told(), noise_,
                 kLampNats});
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
                         .determined = static_cast<double>(sun.error) < kUnknown},
                 .outside = std::move(beforeSun_),
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

FoundLamps LampSearch::result()
{
    FoundLamps found{.powers = {.lamps = {}, .outside = outside_},
                     .residual = static_cast<float>(estimate_.residual),
                     .changeUnseen = changeUnseen(
                         {model_, evidence_.pairs(LampEvidence::kPairsFirst), kin_.alike, noise_,
                          emits_, estimate_.log, camera_, evidence_.texturePlaces(),
                          evidence_.told(), !isResponseSought_},
                         texels_.surfels.seed),
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
        const bool isDetermined = static_cast<double>(lamp.error) < kUnknown;
        if (!isDetermined)
            found.warnings.push_back(unknownAt(lamp.candidate.centre, lamp.ends.size()));
        found.lamps.push_back({std::move(lamp.candidate.patches), glm::vec3(errorOfPower(lamp)),
                               std::move(lamp.onSides), false, isDetermined, std::move(lamp.ends)});
        found.powers.lamps.push_back(lamp.radiance);
    }
    takeSun(found);
    found.camera = std::move(camera_);
    found.doubtOfResponse = doubtOfResponse_;
    stage_.advance();
    return found;
}

double LampSearch::noiseOf(const LightEstimate& estimate)
{
    return std::max(kNoiseOfPairs * estimate.residual, kLeastNoise);
}

FoundLamps LampSearch::run()
{
    if (!evidence_.tells())
        return {.white = std::move(told_.white), .warnings = std::move(warnings_)};
    if (!camera_.isNeutral()) evidence_.linearize(camera_);
    observe();
    const LightFit all = fitOf(LampEvidence::kPairsFirst);
    estimate_ = all.solve(emits_, all.beginning(), kFirstWidth);
    noise_ = noiseOf(estimate_);
    findContrast();
    choose(LampEvidence::kPairsFirst);
    stage_.advance();
    lookCloser();
    choose(LampEvidence::kPairsFirst);
    if (isBent()) {
        bend(LampEvidence::kPairs);
        choose(LampEvidence::kPairsFirst);
    }
    for (int round = 0; round < kChoices && join(); ++round) choose(LampEvidence::kPairsFirst);
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
