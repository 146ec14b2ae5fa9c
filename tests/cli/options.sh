#!/usr/bin/env bash
# The command line: exit codes, messages, where pictures go.
set -u
whit=$(realpath "${WHIT:-build/whit}"); out=${BUILD:-build}/cli; rm -rf "$out"; mkdir -p "$out"; cd "$out" || exit 1
n=0
expect() {                                     # expect NAME CODE TEXT command...: exit code, and TEXT in what it says
    n=$((n + 1))
    local name=$1 code=$2 text=$3 said found; shift 3
    said=$("$@" 2>&1 </dev/null); found=$?
    if [ $found -eq "$code" ] && grep -qF -- "$text" <<<"$said"; then echo "ok $n - $name"
    else echo "not ok $n - $name: exit $found, not $code; said: $(head -c 300 <<<"$said" | tr '\n' ' ')"; fi
}
check() { n=$((n + 1)); local name=$1; shift; if "$@" >/dev/null 2>&1; then echo "ok $n - $name"; else echo "not ok $n - $name"; fi; }

echo 'sphere { z*3, 1 pigment { rgb 1 } finish { ambient 1 } } #debug concat("clock ", str(clock, 0, 2), "\n")' >good.pov
echo 'sphere { z*3, 1' >bad.pov
mkdir -p dir; cp good.pov dir/inner.pov
printf 'Input_File_Name=good.pov\nWidth=20 ; pixels\nHeight=325.77\n[small]\nHeight=10\n' >scene.ini

expect "help" 0 "whit scene.pov" "$whit" --help
check "help goes to standard output" bash -c "'$whit' --help 2>/dev/null | grep -q Exit"
expect "help of everything" 0 "Subset_Start_Frame" "$whit" --help-all
expect "version" 0 "whit " "$whit" --version
expect "no arguments" 2 "no scene given" "$whit"
expect "an unknown switch" 2 "+Z9" "$whit" good.pov +Z9
expect "an unknown key" 2 "Widht" "$whit" good.pov Widht=3
expect "an unknown long option" 2 "--frobnicate" "$whit" good.pov --frobnicate
expect "a threshold must begin with 0" 2 "+A1" "$whit" good.pov +A1
expect "a size of zero" 2 "1 to 100000 pixels" "$whit" good.pov +W0
expect "an unknown picture type" 2 "cannot write pictures of type 'Q'" "$whit" good.pov +FQ
expect "a missing scene" 3 "missing.pov" "$whit" missing.pov
expect "a folder as scene" 3 "dir.pov" bash -c "mkdir -p dir.pov; '$whit' dir.pov"
expect "a mistake in the scene" 1 "bad.pov:" "$whit" bad.pov
expect "a mistake leaves no picture" 1 "" bash -c "rm -f bad.png; '$whit' bad.pov; c=\$?; [ ! -e bad.png ] && exit \$c"
expect "success is silent but for the scene's own words" 0 "clock 0.00" "$whit" good.pov
check "the picture lies next to the scene" bash -c "'$whit' dir/inner.pov && [ -s dir/inner.png ]"
check "a name for the picture" bash -c "'$whit' good.pov +Oname && [ -s name.png ]"
check "another extension is kept" bash -c "'$whit' good.pov +Oa.tga && [ -s a.tga.png ]"
check "a folder for the picture" bash -c "'$whit' dir/inner.pov +O./ && [ -s inner.png ]"
check "a picture on standard output" bash -c "'$whit' good.pov +FP +O- 2>/dev/null | head -c 2 | grep -q P6"
check "a scene on standard input" bash -c "'$whit' - +FP +O- <good.pov 2>/dev/null | head -c 2 | grep -q P6"
expect "a folder that is not there" 3 "nowhere" "$whit" good.pov +Onowhere/x
check "an INI file" bash -c "'$whit' scene.ini +Oini +FP && head -c 12 ini.ppm | tr '\n' ' ' | grep -q 'P6 20 325'"
check "a section of an INI file" bash -c "'$whit' 'scene.ini[small]' +Osec +FP && head -c 12 sec.ppm | tr '\n' ' ' | grep -q 'P6 20 10'"
expect "an INI file that is not there" 2 "nothing.ini" "$whit" nothing.ini
expect "the clock" 0 "clock 0.25" "$whit" good.pov +K0.25
check "an animation" bash -c "'$whit' good.pov +KFF12 +SF2 +EF3 +Oan && [ -s an02.png ] && [ -s an03.png ] && [ ! -e an01.png ]"
expect "declared from outside" 0 "7.5" bash -c "echo '#debug str(V,0,1)' >d.pov; '$whit' --check d.pov Declare=V=7.5"
check "check renders nothing" bash -c "rm -f good.png; '$whit' --check good.pov && [ ! -e good.png ]"
expect "check of a mistake" 1 "bad.pov:" "$whit" --check bad.pov
check "--explain tells the plan" bash -c "'$whit' --explain good.pov | grep -q ."
check "alpha" bash -c "'$whit' good.pov +UA +Oua && [ -s ua.png ]"
expect "diff of equal pictures" 0 "exact" bash -c "'$whit' good.pov; '$whit' diff good.png good.png"
expect "diff of different pictures" 1 "off" bash -c "echo 'background { rgb 1 }' >w.pov; '$whit' w.pov; '$whit' diff good.png w.png -o heat.png"
check "diff writes a heat map" test -s heat.png
expect "diff of different sizes" 2 "size" bash -c "'$whit' good.pov +W20 +H20 +Osmall; '$whit' diff good.png small.png"
expect "diff of something missing" 2 "nothing.png" "$whit" diff good.png nothing.png
expect "diff as JSON" 0 '"verdict":"exact"' "$whit" diff good.png good.png --json
interrupted() {                                # waits until the scene runs, however slow the machine is just now
    echo '#debug "running\n" #while (1) #end' >endless.pov
    "$whit" endless.pov 2>endless.txt & local pid=$!
    for _ in $(seq 600); do grep -q running endless.txt && break; sleep 0.05; done
    kill -INT $pid; wait $pid; local code=$?
    cat endless.txt; return $code
}
expect "a loop without end is interrupted, and says where" 130 "endless.pov:1:" interrupted
