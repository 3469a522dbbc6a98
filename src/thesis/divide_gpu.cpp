#include "thesis/divide_gpu.h"

#include "thesis/divide.comp.h"
#include "thesis/divide.gpu.h"

namespace relamp
{

DivideGpu::DivideGpu(const gpu::Device& device) : program_(device, kDivideSpirv) {}

void DivideGpu::divide(gpu::Commands& commands, const GpuTexels& page,
                       const gpu::Array<glm::uvec2>& direct, const gpu::Array<glm::uvec2>& indirect,
                       const Parameters& parameters, const GpuPicture& albedo) const
{
    commands.dispatch(program_, page.count,
                      DivideArguments{page.radiance.ref(), direct.ref(), indirect.ref(),
                                      page.pixel.ref(), albedo.pixels().ref(), parameters.ambient,
                                      parameters.power, parameters.darkest,
                                      static_cast<uint32_t>(page.count)});
    commands.barrier();
}

} // namespace relamp
