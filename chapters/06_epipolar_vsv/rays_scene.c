// rays: Embree's tree, built for speed.
#include "rays_internal.h"

#include <stdlib.h>

static void embree_failed(void *unused, enum RTCError code, const char *message)
{
    (void)unused;
    fail_work("Embree error %d: %s", (int)code, message);
}

Rays *rays_open(const Mesh *mesh)
{
    Rays *rays = memory_new(1, sizeof *rays, "Embree's scene");
    RTCDevice device = rtcNewDevice(NULL);
    if (device == NULL)
        fail_work("Embree gives no device (error %d)", (int)rtcGetDeviceError(NULL));
    rtcSetDeviceErrorFunction(device, embree_failed, NULL);
    rays->scene = rtcNewScene(device);
    rtcSetSceneBuildQuality(rays->scene, RTC_BUILD_QUALITY_HIGH);
    if (mesh->triangle_count > 0) {
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_HIGH);
        // copies, since Embree reads 16 bytes a vertex: past the end of the mesh's own array
        float *positions = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                   3 * sizeof(float), mesh->vertex_count);
        uint32_t *indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                    3 * sizeof(uint32_t), mesh->triangle_count);
        for (size_t i = 0; i < 3 * mesh->vertex_count; i++)
            positions[i] = mesh->positions[i];
        for (size_t i = 0; i < 3 * mesh->triangle_count; i++)
            indices[i] = mesh->indices[i];
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(rays->scene, geometry);
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(rays->scene);
    rtcReleaseDevice(device);
    return rays;
}

void rays_close(Rays *rays)
{
    if (rays == NULL)
        return;
    rtcReleaseScene(rays->scene);
    free(rays);
}
