// 01 voxelization, surface methods: inclusions, closed forms, invariants, witnesses of what is left out.
#include "surface_bench.h"

Test(surface, methods_include_one_another_on_bunny)
{
    check_inclusions("bunny", 32);
}
Test(surface, methods_include_one_another_on_cornell)
{
    check_inclusions("cornell", 32);
}
Test(surface, methods_include_one_another_on_colonnade)
{
    check_inclusions("colonnade", 32);
}
