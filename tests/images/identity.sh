#!/usr/bin/env bash
# The same bytes for every thread count, accelerator and instruction set; and, for tests/images/scaled/*.pov, for every
# length multiplied by 2^K.
set -u
whit=${WHIT:-build/whit}; out=${BUILD:-build}/identity; mkdir -p "$out"
n=0
render() { "$whit" "$@" +W80 +H60 +FP -A --quiet; }
same() {                                       # same NAME REFERENCE-FILE command...
    n=$((n + 1))
    local name=$1 reference=$2; shift 2
    if "$@" >"$out/now.ppm" 2>"$out/now.txt" && cmp -s "$reference" "$out/now.ppm"; then
        echo "ok $n - $name"
    else
        echo "not ok $n - $name: $(head -2 "$out/now.txt" | tr '\n' ' ')"
    fi
}
for scene in scenes/{showpiece,glass_nested,difference,merge,mesh2,pigment_hexagon,transparent_shadows,light_spot,isosurface,parametric}.pov; do
    name=$(basename "$scene" .pov)
    render "$scene" +WT1 +O- >"$out/one.ppm" 2>/dev/null
    for threads in 2 7; do same "$name with $threads threads" "$out/one.ppm" render "$scene" +WT$threads +O-; done
    same "$name with the plain list" "$out/one.ppm" render "$scene" +WT1 +O- --accel=list
    for isa in base avx2 avx512; do
        same "$name with WHIT_CPU=$isa" "$out/one.ppm" env WHIT_CPU=$isa "$whit" "$scene" +W80 +H60 +FP -A --quiet +WT1 +O-
    done
done
for scene in tests/images/scaled/*.pov; do
    name=$(basename "$scene" .pov)
    render "$scene" Declare=K=0 +O- >"$out/one.ppm" 2>/dev/null
    for k in -300 -100 -40 -20 20 40 100 300; do same "$name times 2^$k" "$out/one.ppm" render "$scene" Declare=K=$k +O-; done
done
