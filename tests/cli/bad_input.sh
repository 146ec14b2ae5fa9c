#!/usr/bin/env bash
# Bad input: each ends in one clear message with file, line and column, the source line and a caret, and its exit code; or
# in a warning, where POV-Ray goes on.
set -u
whit=$(realpath "${WHIT:-build/whit}"); out=${BUILD:-build}/bad; rm -rf "$out"; mkdir -p "$out"; cd "$out" || exit 1
n=0
bad() {                                        # bad NAME CODE PATTERN [SECONDS]: scene text on standard input; PATTERN: extended
    n=$((n + 1))
    local name=$1 code=$2 pattern=$3 said found
    cat >s.pov; rm -f s.png
    said=$(timeout 20 "$whit" s.pov 2>&1 </dev/null); found=$?
    if [ $found -ne "$code" ] || ! grep -qE -- "$pattern" <<<"$said"; then
        echo "not ok $n - $name: exit $found, not $code; said: $(head -c 300 <<<"$said" | tr '\n' ' ')"
    elif [ "$code" -eq 1 ] && { ! grep -q '\^' <<<"$said" || [ -e s.png ]; }; then
        echo "not ok $n - $name: no caret, or a picture in spite of it"
    elif [ "$code" -eq 1 ] && [ "$(grep -c ' error: ' <<<"$said")" -ne 1 ]; then
        echo "not ok $n - $name: not exactly one error"
    else
        echo "ok $n - $name"
    fi
}
bad "an unclosed comment" 1 's\.pov:[0-9]+:[0-9]+: error: .*comment' <<<'sphere { 0, 1 } /* never closed'
bad "an unclosed string" 1 's\.pov:1:[0-9]+: error: .*[Ss]tring' <<<'#debug "never closed'
bad "an unclosed brace" 1 's\.pov:[0-9]+:[0-9]+: error: ' <<<'sphere { 0, 1 pigment { rgb 1 }'
bad "a brace too many" 1 's\.pov:1:17: error: ' <<<'sphere { 0, 1 } }'
bad "an unknown name" 1 "s\.pov:1:[0-9]+: error: .*Radius" <<<'sphere { 0, Radius }'
bad "a keyword in the wrong place" 1 's\.pov:1:[0-9]+: error: ' <<<'sphere { pigment 1 }'
bad "division by zero" 0 's\.pov:1:[0-9]+: warning: Divide by zero' <<<'#declare A = 1/0; sphere { 0, 1 }'
bad "a coordinate that is no number" 0 's\.pov:1:[0-9]+: warning: Divide by zero' <<<'#declare A = 0/0; sphere { <A, 0, 0>, 1 }'
bad "a sphere of no radius" 0 '' <<<'sphere { 0, 0 }'
bad "a flat box" 0 '' <<<'box { 0, <1, 1, 0> }'
bad "a cylinder without length" 1 's\.pov:1:[0-9]+: error: Degenerate cylinder' <<<'cylinder { 0, 0, 1 }'
bad "a cone without length" 1 's\.pov:1:[0-9]+: error: Degenerate cone' <<<'cone { 0, 1, 0, 1 }'
bad "a triangle without area" 0 's\.pov:1:[0-9]+: warning: Degenerate triangle' <<<'triangle { 0, x, 2*x }'
bad "a scale of zero" 0 's\.pov:1:[0-9]+: warning: ' <<<'sphere { 0, 1 scale <1, 0, 1> }'
bad "macros without end" 1 's\.pov:1:[0-9]+: error: ' <<<'#macro M() M() #end M()'
bad "an include of itself" 1 'error: ' <<<'#include "s.pov"'
bad "an include that is missing" 3 "s\.pov:1:[0-9]+: error: .*none\.inc" <<<'#include "none.inc"'
bad "an #if without #end" 1 's\.pov:[0-9]+:[0-9]+: error: ' <<<'#if (1) sphere { 0, 1 }'
bad "an #end too many" 1 's\.pov:1:[0-9]+: error: ' <<<'sphere { 0, 1 } #end'
bad "#error" 1 's\.pov:1:[0-9]+: error: .*stop here' <<<'#error "stop here"'
bad "an array index beyond its end" 1 's\.pov:1:[0-9]+: error: ' <<<'#declare A = array[2] {1, 2}; #debug str(A[5], 0, 0)'
bad "expressions nested without measure" 1 's\.pov:1:[0-9]+: error: ' < <(printf 'sphere { 0, '; head -c 200000 /dev/zero | tr '\0' '('; echo '1 }')
bad "blocks nested without measure" 1 's\.pov:[0-9]+:[0-9]+: error: ' < <(for ((i = 0; i < 100000; i++)); do printf 'union{'; done)
bad "a line of 10 MB" 1 's\.pov:1:[0-9]+: error: ' < <(printf 'sphere { 0, 1 } '; head -c 10000000 /dev/zero | tr '\0' ' '; echo 'cube {')
bad "binary junk" 1 's\.pov:1:[0-9]+: error: ' < <(printf '\x7fELF\x02\x01\x01\x00\x9f\xe2\x83\xff\x10 @@ \x01')
bad "nothing at all" 0 "warning: No objects in scene" <<<''
