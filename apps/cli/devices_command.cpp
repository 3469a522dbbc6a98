#include "command.h"
#include "terminal.h"

#include "relamp/devices.h"

#include <fmt/format.h>

namespace
{

const char* nameOf(relamp::GpuDevice::Type type)
{
    using Type = relamp::GpuDevice::Type;
    switch (type) {
    case Type::discrete:
        return "discrete GPU";
    case Type::integrated:
        return "integrated GPU";
    case Type::virtualized:
        return "virtual GPU";
    case Type::software:
        return "software";
    case Type::other:
        break;
    }
    return "other";
}

int printDevices()
{
    const std::vector<relamp::GpuDevice> devices = relamp::gpuDevices();
    printOut("cpu  {}\n", relamp::cpuDevice());
    for (size_t i = 0; i < devices.size(); ++i)
        printOut("{:<4} {}, {}, {:.1f} GB, {}\n", i, devices[i].name, nameOf(devices[i].type),
                 1e-9 * static_cast<double>(devices[i].memory), devices[i].driver);
    if (devices.empty()) printOut("No device that does Vulkan 1.2: the CPU does everything.\n");
    return 0;
}

} // namespace

void addDevicesCommand(CLI::App& app, Run& run)
{
    CLI::App& command = *app.add_subcommand("devices", "List what --engine and --gpu choose from");
    command.footer("Example:\n  relamp devices");
    command.callback([&run] { run = printDevices; });
}
