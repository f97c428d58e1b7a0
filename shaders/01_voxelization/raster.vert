// raster.vert: positions in voxels, rebased in double.
layout(location = 0) in vec3 position;
uniform dvec3 grid_origin;
uniform double voxel_size;
out vec3 voxel_position;

void main()
{
    voxel_position = vec3((dvec3(position) - grid_origin) / voxel_size);
}
