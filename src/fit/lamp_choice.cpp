#include "fit/lamp_choice.h"

#include "base/parallel.h"
#include "base/radiometry.shared.h"
#include "fit/light_gain.h"
#include "lights/candidates.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>

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

// Numerics.
constexpr double kLeanNats = 0.03; // what no light asks for does not shine
constexpr double kTries = 4.0;     // of the most promising pieces of a room, each time one is added
constexpr float kHardlyCommon = 0.01f; // of two lamps' light at places, that comes to the same ones
constexpr float kNearlyAll = 0.8f;     // likewise, where one may be taken for the other
constexpr int kChoices = 4;            // rounds of taking away and adding, at most

bool emitsAny(std::span<const uint32_t> pieces, std::span<const uint8_t> emits)
{
    return std::ranges::any_of(pieces, [&](uint32_t piece) { return emits[piece] != 0; });
}

float sumOf(std::span<const float> light)
{
    return std::max(std::accumulate(light.begin(), light.end(), 0.0f), kFaintest);
}

/// Of two lamps' light at places, the share that comes to the same ones.
float commonOf(std::span<const float> light, std::span<const float> other)
{
    const float all = sumOf(light);
    const float allOfOther = sumOf(other);
    float common = 0.0f;
    for (size_t i = 0; i < light.size(); ++i)
        common += std::min(light[i] / all, other[i] / allOfOther);
    return common;
}

/// One choice: chooseLamps().
class LampChoice
{
public:
    LampChoice(const FittedLight& light, std::span<const Choosable> pieces,
               const CameraColumns& camera)
        : light_(light), pieces_(pieces), camera_(camera),
          fit_(light.model, light.pairs, light.alike, light.noise)
    {
        chosen_.emits.assign(light.emits.begin(), light.emits.end());
        fit_.believe(light.told);
        fit_.expectLeaks(light.log);
    }

    ChosenLight run()
    {
        solveFrom({light_.log.begin(), light_.log.end()});
        prune();
        takeTurns();
        int round = 0;
        while (round < kChoices && improve()) ++round;
        if (chosen_.estimate.error.empty()) solveFrom(chosen_.estimate.start());
        return std::move(chosen_);
    }

private:
    struct Addition
    {
        uint32_t piece = 0;
        double gain = 0.0;    // nats
        double log = 0.0;     // radiance to start from
        double byBound = 0.0; // nats, where no light asks for it, as far as is known without a fit
        LightEstimate estimate{};
    };

    struct Trial
    {
        ChosenLight light{};
        double lost = 0.0; // nats
    };

    struct Exchange
    {
        uint32_t from = 0; // emits,
        uint32_t to = 0;   // and would in its place
        float asMuch = 1;  // radiance of that for the same light
    };

    void solveFrom(std::vector<double> start);
    [[nodiscard]] bool mayCome(uint32_t piece) const;
    [[nodiscard]] double costOf(std::span<const uint8_t> emits) const;
    [[nodiscard]] double natsOf(const ChosenLight& light) const;
    [[nodiscard]] Removal removalOf(std::vector<uint32_t> pieces, double cost) const;
    [[nodiscard]] std::vector<Removal> removals() const;
    void prune();
    [[nodiscard]] std::vector<float> lightOf(std::span<const uint32_t> pieces) const;
    [[nodiscard]] std::vector<size_t> apart(std::span<const std::vector<uint32_t>> sets) const;
    void drop();
    [[nodiscard]] std::vector<Addition> bestAdditions() const;
    bool grow();
    void takeTurns();
    [[nodiscard]] std::vector<Exchange> exchanges() const;
    bool exchange();
    bool improve();

    const FittedLight& light_;
    std::span<const Choosable> pieces_;
    const CameraColumns& camera_;
    LightFit fit_;
    ChosenLight chosen_;
};

void LampChoice::solveFrom(std::vector<double> start)
{
    chosen_.estimate = fit_.solve(chosen_.emits, std::move(start), camera_);
}

/// It does not emit, and might.
bool LampChoice::mayCome(uint32_t piece) const
{
    return chosen_.emits[piece] == 0 && !pieces_[piece].isUnseen &&
           (pieces_[piece].isOpening || light_.model.area[piece] > 0.0f);
}

/// Nats against these emitting: those of one model, and what leans on them, are believed together.
double LampChoice::costOf(std::span<const uint8_t> emits) const
{
    double nats = 0.0;
    std::vector<uint8_t> before(emits.size(), 0);
    for (uint32_t f = 0; f < emits.size(); ++f) {
        if (emits[f] == 0) continue;
        if (!pieces_[f].isGiven) nats += std::max(natsToEmit(pieces_[f], before), 0.0);
        before[f] = 1;
    }
    return nats;
}

/// The less, the likelier.
double LampChoice::natsOf(const ChosenLight& light) const
{
    return light.estimate.nats + costOf(light.emits);
}

/// These with all that leans on nothing else.
Removal LampChoice::removalOf(std::vector<uint32_t> pieces, double cost) const
{
    std::vector<uint8_t> isGone(pieces_.size(), 0);
    for (const uint32_t piece : pieces) isGone[piece] = 1;
    Removal removal{std::move(pieces), cost};
    for (size_t k = 0; k < removal.pieces.size(); ++k)
        for (uint32_t f = 0; f < pieces_.size(); ++f) {
            if (chosen_.emits[f] == 0 || isGone[f] != 0 || pieces_[f].isGiven) continue;
            const std::vector<uint32_t>& on = pieces_[f].leansOn;
            const auto isLeft = [&](uint32_t other) {
                return chosen_.emits[other] != 0 && isGone[other] == 0;
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
std::vector<Removal> LampChoice::removals() const
{
    std::vector<Removal> removals;
    const auto mayGo = [&](uint32_t f) { return chosen_.emits[f] != 0 && !pieces_[f].isGiven; };
    for (uint32_t f = 0; f < pieces_.size(); ++f) {
        if (!mayGo(f)) continue;
        removals.push_back(removalOf({f}, natsToEmit(pieces_[f], chosen_.emits)));
        std::vector<uint32_t> model{f};
        std::copy_if(pieces_[f].model.begin(), pieces_[f].model.end(), std::back_inserter(model),
                     mayGo);
        if (model.size() > 1) removals.push_back(removalOf(std::move(model), kLampNats));
    }
    return removals;
}

/// Lets no piece emit that the rest explains, as far as the cost's quadratic form tells.
void LampChoice::prune()
{
    for (;;) {
        const std::vector<Removal> removals = this->removals();
        const std::vector<uint8_t> gone =
            fit_.needless(chosen_.estimate, chosen_.emits, removals, camera_);
        if (std::all_of(gone.begin(), gone.end(), [](uint8_t g) { return g == 0; })) return;
        for (size_t k = 0; k < removals.size(); ++k)
            if (gone[k] != 0)
                for (const uint32_t piece : removals[k].pieces) chosen_.emits[piece] = 0;
        solveFrom(chosen_.estimate.start());
    }
}

/// At places, of all of them at radiance 1.
std::vector<float> LampChoice::lightOf(std::span<const uint32_t> pieces) const
{
    std::vector<uint8_t> isOne(light_.model.pieces, 0);
    for (const uint32_t piece : pieces) isOne[piece] = 1;
    std::vector<float> light(light_.model.places(), 0.0f);
    for (size_t i = 0; i < light.size(); ++i)
        for (const auto [piece, direct] : light_.model.direct[i])
            if (isOne[piece] != 0) light[i] += direct;
    return light;
}

/// Which sets of pieces can be decided on at once, from the first on: each lights hardly a place
/// that one before it lights, as lamps of two rooms do.
std::vector<size_t> LampChoice::apart(std::span<const std::vector<uint32_t>> sets) const
{
    std::vector<size_t> apart;
    std::vector<std::vector<float>> lights;
    for (size_t k = 0; k < sets.size(); ++k) {
        std::vector<float> light = lightOf(sets[k]);
        if (!std::ranges::all_of(lights, [&](const std::vector<float>& other) {
                return commonOf(light, other) < kHardlyCommon;
            }))
            continue;
        apart.push_back(k);
        lights.push_back(std::move(light));
    }
    return apart;
}

/// The same by fits without each of them; the least needed goes first, and with it what is apart
/// from it.
void LampChoice::drop()
{
    for (;;) {
        std::vector<Removal> removals = this->removals();
        std::vector<Trial> trials(removals.size());
        forEach(trials.size(), [&](size_t k) {
            trials[k].light.emits = chosen_.emits;
            for (const uint32_t piece : removals[k].pieces) trials[k].light.emits[piece] = 0;
            const double most = chosen_.estimate.nats + removals[k].cost;
            trials[k].light.estimate =
                fit_.trial(trials[k].light.emits, chosen_.estimate.start(), most, camera_);
            trials[k].lost = trials[k].light.estimate.nats - most;
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
            for (const uint32_t piece : sets[set]) chosen_.emits[piece] = 0;
        chosen_.estimate = gone.size() == 1 ? std::move(trials[needless.front()].light.estimate)
                                            : fit_.trial(chosen_.emits, chosen_.estimate.start(),
                                                         INFINITY, camera_);
    }
}

/// The pieces whose emission gains most, apart from each other; none where nothing gains.
std::vector<LampChoice::Addition> LampChoice::bestAdditions() const
{
    std::vector<Addition> additions;
    for (uint32_t f = 0; f < pieces_.size(); ++f)
        if (mayCome(f)) additions.push_back({f});
    const LightGain gain(fit_, chosen_.estimate, camera_);
    forEach(additions.size(), [&](size_t k) {
        Addition& a = additions[k];
        const double saved = gain.of(a.piece, a.log);
        a.gain = saved - natsToEmit(pieces_[a.piece], chosen_.emits);
        // Others may have taken a window's light over: then its bound alone speaks for it.
        if (a.log == 0.0 && saved > kLampNats &&
            !emitsAny(pieces_[a.piece].leansOn, chosen_.emits)) {
            a.log = gain.leastOf(a.piece);
            a.byBound = saved;
        }
    });
    const auto sort = [&] {
        std::stable_sort(additions.begin(), additions.end(),
                         [](const Addition& a, const Addition& b) { return a.gain > b.gain; });
    };
    sort();
    std::erase_if(additions, [](const Addition& a) { return a.log <= 0.0; });
    additions.resize(std::min(additions.size(), static_cast<size_t>(kTries * light_.model.rooms)));
    forEach(additions.size(), [&](size_t k) {
        Addition& a = additions[k];
        std::vector<uint8_t> with = chosen_.emits;
        with[a.piece] = 1;
        std::vector<double> start = chosen_.estimate.start();
        start[a.piece] = a.log;
        const double most = chosen_.estimate.nats - natsToEmit(pieces_[a.piece], chosen_.emits);
        a.estimate = fit_.trial(with, std::move(start), most, camera_);
        a.gain = most - a.estimate.nats;
        // That its light is asked for, a fit must tell.
        if (a.byBound > 0.0 && chosen_.estimate.nats - a.estimate.nats < a.byBound + kLeanNats)
            a.gain = 0.0;
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
bool LampChoice::grow()
{
    for (bool isAny = false;; isAny = true) {
        std::vector<Addition> best = bestAdditions();
        if (best.empty()) return isAny;
        std::vector<double> start = chosen_.estimate.start();
        for (const Addition& a : best) {
            chosen_.emits[a.piece] = 1;
            start[a.piece] = a.log;
        }
        chosen_.estimate = best.size() == 1
                               ? std::move(best.front().estimate)
                               : fit_.trial(chosen_.emits, std::move(start), INFINITY, camera_);
    }
}

/// What lights nearly the same places may have been taken for another: a shade for the bulb in it,
/// the ceiling around a lamp for the lamp. By what is not 0: a hall has many pieces and places.
std::vector<LampChoice::Exchange> LampChoice::exchanges() const
{
    const std::span direct(light_.model.direct.data(), light_.model.places());
    std::vector<float> all(pieces_.size(), 0.0f); // that each sends to places
    for (const auto& ofPlace : direct)
        for (const auto [piece, sent] : ofPlace) all[piece] += sent;
    for (float& sent : all) sent = std::max(sent, kFaintest);
    std::vector<Exchange> exchanges;
    for (uint32_t from = 0; from < pieces_.size(); ++from) {
        if (chosen_.emits[from] == 0 || pieces_[from].isGiven) continue;
        std::vector<float> common(pieces_.size(), 0.0f); // as commonOf() has it
        for (size_t i = 0; i < direct.size(); ++i)
            if (const float share = light_.model.directAt(i, from) / all[from]; share > 0.0f)
                for (const auto [to, sent] : direct[i])
                    common[to] += std::min(share, sent / all[to]);
        for (uint32_t to = 0; to < pieces_.size(); ++to)
            if (mayCome(to) && !pieces_[to].isOpening && common[to] > kNearlyAll)
                exchanges.push_back({from, to, all[from] / all[to]});
    }
    return exchanges;
}

/// Lets a piece emit in place of one that was taken for it, where that is likeliest: both light
/// nearly the same places, so that neither taking the one away nor adding the other gains anything.
/// False where all is as likely as it can be.
bool LampChoice::exchange()
{
    const std::vector<Exchange> exchanges = this->exchanges();
    const double before = natsOf(chosen_);
    std::vector<Trial> trials(exchanges.size());
    forEach(trials.size(), [&](size_t k) {
        const auto& [from, to, asMuch] = exchanges[k];
        Trial& trial = trials[k];
        trial.light.emits = chosen_.emits;
        for (const uint32_t piece : removalOf({from}, 0.0).pieces) trial.light.emits[piece] = 0;
        trial.light.emits[to] = 1;
        std::vector<double> start = chosen_.estimate.start();
        start[to] = start[from] + std::log(static_cast<double>(asMuch));
        const double most = before - costOf(trial.light.emits);
        trial.light.estimate = fit_.trial(trial.light.emits, std::move(start), most, camera_);
        trial.lost = trial.light.estimate.nats - most;
    });
    const auto best = std::ranges::min_element(trials, {}, &Trial::lost);
    if (best == trials.end() || best->lost >= 0.0) return false;
    chosen_ = std::move(best->light);
    return true;
}

/// Where one takes away what the other adds, the likelier of the two stays.
void LampChoice::takeTurns()
{
    std::vector<uint8_t> dropped; // what emitted after the last drop(),
    ChosenLight grown;            // and what grow() made of it
    for (int round = 0; round < kChoices; ++round) {
        drop();
        if (round > 0 && chosen_.emits == dropped) {
            if (natsOf(grown) < natsOf(chosen_)) chosen_ = std::move(grown);
            return;
        }
        dropped = chosen_.emits;
        if (!grow()) return;
        grown = chosen_;
    }
}

/// An exchange, and what is needed then; false where that is no likelier.
bool LampChoice::improve()
{
    ChosenLight before = chosen_;
    if (!exchange()) return false;
    takeTurns();
    if (natsOf(chosen_) < natsOf(before)) return true;
    chosen_ = std::move(before);
    return false;
}

} // namespace

double natsOfLamp()
{
    return kLampNats;
}

double natsOfSize(float area)
{
    const float divisor = std::max(area, std::numeric_limits<float>::min());
    return std::max(std::log(static_cast<double>(kCrumb / divisor)), 0.0);
}

double natsToEmit(const Choosable& piece, std::span<const uint8_t> emits)
{
    if (emitsAny(piece.leansOn, emits)) return kLeanNats;
    return piece.natsOfSize + (emitsAny(piece.model, emits) ? kModelNats : kLampNats);
}

ChosenLight chooseLamps(const FittedLight& light, std::span<const Choosable> pieces,
                        const CameraColumns& camera)
{
    return LampChoice(light, pieces, camera).run();
}

} // namespace relamp
