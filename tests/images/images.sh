#!/usr/bin/env bash
# Renders every row of tests/images.tsv and compares it with reference/: the verdict must be as good as the row's.
set -u
whit=${WHIT:-build/whit}; out=${BUILD:-build}/images; mkdir -p "$out"
n=0
while IFS=$'\t' read -r name options verdict reason; do
    [ "$name" = scene ] && continue
    n=$((n + 1))
    # shellcheck disable=SC2086
    if ! said=$("$whit" "scenes/$name.pov" $options "+O$out/$name.png" 2>&1); then
        echo "not ok $n - $name: $said"
    elif found=$("$whit" diff "$out/$name.png" "reference/$name.png" --verdict="$verdict" -o "$out/$name.heat.png"); then
        echo "ok $n - $name is $verdict"
    else
        echo "not ok $n - $name should be $verdict but is $found"
    fi
done <tests/images.tsv
listed=$(tail -n +2 tests/images.tsv | cut -f1 | sort); there=$(cd scenes && ls -- *.pov | sed 's/\.pov$//' | sort)
n=$((n + 1))
if [ "$listed" = "$there" ]; then echo "ok $n - every scene has its row"; else echo "not ok $n - scenes and tests/images.tsv differ"; fi
