#!/bin/sh
# rays.sh BUILD OPTIONS…: how fast chapter 06's shadow rays are beside a bare loop over a share of the same rays, as CSV: a row a scene, of three runs the one
# whose share of the bare loop's speed is in the middle.
build=$1
shift
echo scene,rays_a_pixel,million_a_second,bare_loop,share
for scene in fence toroid colonnade forest bunny cell24 crowd; do
    for run in 1 2 3; do
        "$build/06_epipolar_vsv" --scene "$scene" --size 1024x1024 --set method=rays --step airlight --out "$build/06_rays.exr" "$@" 2>&1
    done | awk -v scene="$scene" '
        /million a second/ {
            for (i = 1; i < NF; i++) {
                if ($i ~ /^rays,/) rays = $(i - 1)
                if ($i == "time") own = $(i + 1) + 0
                if ($i == "loop") bare = $(i + 1) + 0
            }
            row[++n] = sprintf("%s,%.0f,%.4g,%.4g,%.4g", scene, rays / 1048576, own, bare, own / bare)
            share[n] = own / bare
        }
        END {
            if (n != 3) exit 1
            for (i = 1; i <= 3; i++) {
                below = 0
                for (k = 1; k <= 3; k++) below += share[k] < share[i] || (share[k] == share[i] && k < i)
                if (below == 1) print row[i]
            }
        }' || exit 1
done
