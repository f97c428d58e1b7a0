# Chapter 06's figures of speed from its sweep, a line for each scene and setting of the technique:
#
#   build/06_epipolar_vsv --scene fence --size 1024x1024 --sweep fence.csv && awk -f tests/tools/speed.awk fence.csv
#
# equal samples: run time of 512 shadow rays a pixel over the technique's own passes, with the middle 95 % of 1000 resamples of both rows' repeats; the
# error against the truth over that of those rays; equal error: the fewest rays that are as near to the truth, over the technique; frame: the same ratio of whole
# frames; equiangular: brute force on the same map at the same error against its limit, straight lines between its settings in log-log, in both metrics.
function median(list, n,    i, j, t) {
    for (i = 2; i <= n; i++) for (j = i; j > 1 && list[j] < list[j - 1]; j--) { t = list[j]; list[j] = list[j - 1]; list[j - 1] = t }
    return n % 2 ? list[(n + 1) / 2] : 0.5 * (list[n / 2] + list[n / 2 + 1])
}
function resampled(row,    from, n, i, drawn) {
    n = split(repeats[row], from, " ")
    for (i = 1; i <= n; i++) drawn[i] = from[1 + int(n * rand())]
    return median(drawn, n)
}
function interval(above, below,    i, ratio) {
    for (i = 1; i <= 1000; i++) ratio[i] = resampled(above) / resampled(below)
    median(ratio, 1000) # in order now
    return sprintf("%.4g..%.4g", ratio[25], ratio[976])
}
# Milliseconds of brute force at this error, or a bound.
function brute_ms(scene, metric, wanted,    i, a, b, e0, e1, best, ms) {
    best = -1
    for (i = 1; i <= rows; i++) {
        a = name[i]
        if (scene_of[a] != scene || technique[a] != "equiangular") continue
        if (error[a, "converged", metric] <= wanted && (best < 0 || time[a] < best)) { best = time[a]; b = a }
    }
    if (best < 0) return "-1"
    for (i = 1; i <= rows; i++) {
        a = name[i]
        e0 = error[a, "converged", metric]; e1 = error[b, "converged", metric]
        if (scene_of[a] != scene || technique[a] != "equiangular" || time[a] >= time[b] || e0 <= wanted || e0 <= e1) continue
        ms = exp(log(time[b]) + (log(time[a]) - log(time[b])) * log(wanted / e1) / log(e0 / e1))
        if (ms < best) best = ms
    }
    return best
}
function ratio_text(value, by) { return value < 0 ? "not reached" : sprintf("%.3g", value / by) }
BEGIN { FS = ","; srand(1) }
/^#/ || $1 == "chapter" { next }
{
    row = $2 SUBSEP $3 SUBSEP $6
    if (!(row in time)) name[++rows] = row
    technique[row] = $2; scene_of[row] = $3; settings[row] = $6; time[row] = $7 + 0; frame[row] = $10 + 0; repeats[row] = $14
    error[row, $11, $12] = $13 + 0
}
END {
    for (i = 1; i <= rows; i++) {
        row = name[i]
        if (technique[row] != "map" && technique[row] != "prefix") continue
        rays = fewest = ""
        for (k = 1; k <= rows; k++) {
            other = name[k]
            if (scene_of[other] != scene_of[row] || technique[other] != "rays") continue
            if (settings[other] ~ /phi=512/) rays = other
            if (error[other, "truth", "rel_rmse"] <= error[row, "truth", "rel_rmse"] && (fewest == "" || time[other] < time[fewest])) fewest = other
        }
        printf "%s %s: %.1f ms", scene_of[row], settings[row], time[row]
        if (rays != "")
            printf "; equal samples %.4g (%s), error %.2f of theirs; equal error %s; frame %.4g", time[rays] / time[row], interval(rays, row),
                   error[row, "truth", "rel_rmse"] / error[rays, "truth", "rel_rmse"], fewest == "" ? "not reached" : sprintf("%.4g", time[fewest] / time[row]), frame[rays] / frame[row]
        printf "; equiangular %s in rel_rmse, %s in nrmse; map's share %.2g\n", ratio_text(brute_ms(scene_of[row], "rel_rmse", error[row, "converged", "rel_rmse"]), time[row]),
               ratio_text(brute_ms(scene_of[row], "nrmse", error[row, "converged", "nrmse"]), time[row]), error[row, "truth", "map_rel_rmse"] / error[row, "converged", "rel_rmse"]
    }
}
