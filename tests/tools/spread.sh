#!/bin/sh
# spread.sh BUILD SIZE: what each spread of chapter 06's light rays costs in error against the same map without a grid, as CSV: a row for each scene, integral
# and number of φ, a column for each metric and spread. SIZE as 512x512.
build=$1 size=$2 program=$1/06_epipolar_vsv
set -e
echo scene,settings,rel_even,rel_square,rel_borders,nrmse_even,nrmse_square,nrmse_borders
for scene in fence toroid colonnade forest bunny cell24 crowd; do
    draw="$program --scene $scene --size $size --step airlight --set map=2048"
    $draw --set method=segments --out "$build/06_limit.exr"
    for settings in integral=runs 'integral=prefix filter=epipolar'; do
        for phi in 128 512; do
            sets= rel= nrmse=
            for set in $settings phi=$phi; do
                sets="$sets --set $set"
            done
            for warp in even square borders; do
                # shellcheck disable=SC2086
                $draw $sets --set warp=$warp --out "$build/06_spread.exr"
                errors=$("$build/compare" "$build/06_spread.exr" "$build/06_limit.exr" | sed -n 2p)
                nrmse=$nrmse,$(echo "$errors" | cut -d, -f3)
                rel=$rel,$(echo "$errors" | cut -d, -f4)
            done
            echo "$scene,$(echo "$settings phi=$phi" | tr ' ' ';')$rel$nrmse"
        done
    done
done
