#pragma once

#include "gpu/device.h"
#include "gpu/in_force.h"
#include "relamp/devices.h"
#include "relamp/error.h"

#include <functional>
#include <memory>
#include <string>
#include <utility>

#include <tbb/task_arena.h>

namespace relamp::gpu
{

/// The device that options ask for.
struct Choice
{
    std::unique_ptr<Device> device; // null: the CPU
    bool isFree = true;             // nobody asked for this engine
    std::string note;               // a sentence where the CPU had to take over; else empty

    /// Throws Error(device) where a GPU is asked for and there is none.
    static Choice of(const EngineOptions& options);
};

/// What to tell where `error` ended the work of a device.
std::string handedOver(const Error& error);

/// What a GPU computes in place of the CPU, as the options say; made when it is first asked for.
///
/// A device that nobody asked for and that fails hands over to the CPU, for good. Where other work
/// fails half-way, the next gets new stages: what these take for computed need not be.
///
/// To be used by one thread at a time, so mostly under a lock: where stages loop on all threads,
/// the one that waits for them takes up nothing else, which might want the same lock.
template<class Stages>
class Twin
{
public:
    using Make = std::function<std::unique_ptr<Stages>(const Device&)>;

    Twin(Choice choice, Make make) : choice_(std::move(choice)), make_(std::move(make)) {}

    /// Calls `work(stages)`. False where the CPU has to do it. Throws Error(device) where a device
    /// that was asked for fails.
    template<class Work>
    bool compute(const Work& work)
    {
        if (!choice_.device) return false;
        try {
            tbb::this_task_arena::isolate([&] {
                if (!stages_) stages_ = make_(*choice_.device);
                work(*stages_);
            });
            return true;
        } catch (const Error& error) {
            stages_.reset(); // before the device that it works on
            if (!choice_.isFree || error.code() != ErrorCode::device) throw;
            choice_ = {.note = handedOver(error)};
        } catch (...) {
            stages_.reset();
            throw;
        }
        return false;
    }

    [[nodiscard]] bool isCpu() const { return !choice_.device; }
    /// "cpu", or the name of the GPU.
    [[nodiscard]] std::string name() const
    {
        return choice_.device ? choice_.device->description().name : "cpu";
    }
    /// As Choice::note.
    [[nodiscard]] const std::string& note() const { return choice_.note; }
    [[nodiscard]] InForce inForce() const
    {
        return {{isCpu() ? Engine::cpu : Engine::gpu, name()}, note()};
    }

private:
    Choice choice_;
    Make make_;
    std::unique_ptr<Stages> stages_;
};

} // namespace relamp::gpu
