#pragma once

namespace relamp::bench
{

/// What this machine can do at best with all its cores, measured once a run: the floor under every
/// stage's time.
struct Machine
{
    double bytesPerSecond; // read and written by a copy that does not fit any cache
    double flopsPerSecond; // multiply-adds (two each) in the widest vectors
};
const Machine& machine();

/// Least seconds for work that moves `bytes` and computes `flops`, whichever takes longer.
double floorSeconds(double bytes, double flops);

} // namespace relamp::bench
