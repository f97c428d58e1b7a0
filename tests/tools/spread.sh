#!/bin/sh
# spread.sh BUILD SIZE: what each spread of chapter 06's light rays costs in error against the same map without a grid, as CSV. SIZE as 512x512.
build=$1 size=$2 program=$1/06_epipolar_vsv
set -e
echo scene,settings,nrmse,rel_rmse
for scene in fence toroid colonnade forest bunny cell24 crowd; do
    draw="$program --scene $scene --size $size --step airlight --set map=2048"
    $draw --set method=segments --out "$build/06_limit.exr"
    for settings in integral=runs 'integral=prefix filter=epipolar'; do
        for phi in 128 512; do
            for warp in even square borders; do
                sets=
                for set in $settings phi=$phi warp=$warp; do
                    sets="$sets --set $set"
                done
                # shellcheck disable=SC2086
                $draw $sets --out "$build/06_spread.exr"
                errors=$("$build/compare" "$build/06_spread.exr" "$build/06_limit.exr" | awk -F, 'NR == 2 { print $3 "," $4 }')
                echo "$scene,$(echo "$settings phi=$phi warp=$warp" | tr ' ' ';'),$errors"
            done
        done
    done
done
