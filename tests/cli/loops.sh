#!/usr/bin/env bash
# Statements say the same as text and in a loop, where plain ones take a short way: trace(), functions, arrays, new names.
set -u
whit=$(realpath "${WHIT:-build/whit}"); out=${BUILD:-build}/cli-loops; rm -rf "$out"; mkdir -p "$out"; cd "$out" || exit 1
n=0
same() {                                       # same NAME STATEMENTS: they may use V(a) to show a vector
    n=$((n + 1))
    local head='#version 3.7; global_settings { assumed_gamma 1 } sphere { 0, 1 }
        #declare O = sphere { 0, 1 } #declare F = function(x, y) { x * y + 1 } #declare R = seed(4); #declare N = <1, 2, 3>;
        #declare P = function { pigment { gradient x color_map { [0 rgb 0] [1 rgbt <1, 0.5, 0.2, 0.3>] } } }
        #declare A = array[2] { <1, 2, 3>, <4, 5, 6> } #declare B = array[2][2] { { 1, 2 }, { 3, 4 } } #declare C = array[4];
        #macro V(X) concat("<", vstr(5, X, ",", 0, 17), ">\n") #end #macro Two(X, Y) X * 2 + Y #end
        '
    echo "$head $2" >text.pov
    echo "$head #for (I_, 0, 0) $2 #end" >loop.pov
    "$whit" --check text.pov >text.txt 2>&1 </dev/null; "$whit" --check loop.pov >loop.txt 2>&1 </dev/null
    if grep -q '^<' text.txt && cmp -s text.txt loop.txt; then echo "ok $n - $1"
    else echo "not ok $n - $1: $(head -c 300 text.txt loop.txt | tr '\n' ' ')"; fi
}

same "a normal is read after its trace" '#declare A1 = trace(O, <0, 0.5, -5>, z, N) + N; #debug V(A1) #debug V(N)'
same "and before it" '#declare A1 = N + trace(O, <0, 0.5, -5>, z, N); #debug V(A1) #debug V(N)'
same "a point in the place of its normal" '#declare N = trace(O, <0, 0.5, -5>, z, N); #debug V(N)'
same "a ray that misses" '#declare A1 = trace(O, <0, 5, -5>, z, N); #debug V(A1) #debug V(N)'
same "functions, streams and subscripts" '#declare A1 = A[1] * B[1][0] + <F(2, 3), rand(R), B[0][1]>; #debug V(A1) #debug V(rand(R))'
same "an attempt given up leaves the stream" '#declare A1 = rand(R) * <1, 2, 3> + Two(rand(R), 1); #debug V(A1)'
same "functions of vectors" '#declare A1 = vaxis_rotate(x, y + z, 30) - vcross(A[0], A[1]) / 3 + vnormalize(<1, 1>); #debug V(A1)'
same "pigments and relations" '#declare A1 = (1 < 2 ? 3 : 4) + !0 + (2 >= 2 & 3 != 3 | 1) + P(0.3, 0, 0).red; #debug V(A1)'
same "items of arrays" '#declare C[1] = 2; #declare C[2] = 3; #declare C[1] = C[1] + C[2]; #debug V(C[1])'
same "a name that changes its type" '#declare Q = x; #declare Q = 3; #declare A1 = Q + N; #debug V(A1) #declare Q = "s"; #debug concat("<", Q, "\n")'
same "colours in single precision" '#declare Q = <0.1, 0.2, 0.3, 0.4, 0.5>; #declare A1 = Q * 2; #debug V(A1)'
same "a macro and its arguments" '#declare A1 = Two(N, A[1]) + Two(F(1, 2), -2); #debug V(A1)'
same "written items" '#fopen W "w.txt" write #write (W, "\"a", str(pi, 0, 5), ",", str(-0.5, 8, 3), concat("b", "c"), 1/4, "\"\n") #fclose W
    #fopen W "w.txt" read #read (W, Q) #fclose W #debug concat("<", Q, "\n")'
