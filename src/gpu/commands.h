#pragma once

#include "gpu/buffer.h"
#include "gpu/device.h"
#include "gpu/owned.h"
#include "gpu/program.h"
#include "gpu/vulkan.h"
#include "relamp/api.h"

#include <string>
#include <vector>

namespace relamp::gpu
{

/// How long a part of the work took, by the device's own clock.
struct Timing
{
    std::string name;
    double seconds = 0.0;
};

/// Work for a device, written down first and then run at once.
class RELAMP_API Commands
{
public:
    explicit Commands(const Device& device);
    ~Commands();
    Commands(const Commands&) = delete;
    Commands& operator=(const Commands&) = delete;

    /// To be written to by Vulkan's own calls.
    [[nodiscard]] VkCommandBuffer handle() const { return commands_; }

    /// `threads` threads of a program; `arguments` is the struct that the shader declares by the
    /// same name. Nothing happens for no threads.
    template<class Arguments>
    void dispatch(const Program& program, size_t threads, const Arguments& arguments)
    {
        static_assert(sizeof(Arguments) <= Device::kArgumentBytes);
        dispatch(program, threads, std::as_bytes(std::span(&arguments, 1)));
    }
    void copy(const Buffer& from, size_t fromByte, const Buffer& to, size_t toByte, size_t count);
    void clear(const Buffer& buffer); // to bytes 0
    /// What follows sees all that was written before.
    void barrier();
    /// What comes from here on, up to the next mark or the end, is timed under this name.
    void mark(const std::string& name);

    /// Runs everything and waits; once. Throws Error(device) where the device gives up.
    void run();
    /// The same in two steps. What is copied waits for `ready`, and `done` is signalled in the end.
    void start(VkSemaphore ready = VK_NULL_HANDLE, VkSemaphore done = VK_NULL_HANDLE);
    void wait();
    /// Of the marks, in their order, after run(). Parts of one name are added up.
    [[nodiscard]] std::vector<Timing> timings() const;

private:
    static constexpr uint32_t kMostMarks = 256;

    void dispatch(const Program& program, size_t threads, std::span<const std::byte> arguments);
    void stamp();

    const Device& device_;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
    Owned<VkFence> ended_;
    Owned<VkQueryPool> stamps_; // made with the first mark
    std::vector<std::string> marks_;
    uint32_t stampCount_ = 0;
};

} // namespace relamp::gpu
