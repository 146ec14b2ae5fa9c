/* test_directives.c - what directives, macros, arrays, strings and files do, told by #debug. Each row was run on povray. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "sdl/run.h"

typedef struct Row { const char *text, *said; } Row;

static const Row flow[] = {
    { "#if (1) #debug \"a\n\" #else #debug \"b\n\" #end", "a\n" },
    { "#if (0) #debug \"1\n\" #elseif (1) #debug \"2\n\" #elseif (1) #debug \"3\n\" #else #debug \"4\n\" #end", "2\n" },
    { "#if (0) #if (1) #else #end #debug \"1\n\" #elseif (0) #else #debug \"4\n\" #end", "4\n" },
    { "#ifdef (X) #debug \"y\n\" #else #debug \"n\n\" #end #ifndef (pi) #debug \"no pi\n\" #end", "n\nno pi\n" },
    { "#while (1) #break #debug \"no\n\" #end #debug \"done\n\"", "done\n" },
    { "#declare I=0; #while (I<5) #declare I=I+1; #if (I=3) #break #end #debug concat(str(I,0,0),\"\n\") #end", "1\n2\n" },
    { "#for (I, 1, 3) #debug concat(str(I,0,0),\" \") #end #debug concat(str(I,0,1),\"\n\")", "1 2 3 4.0\n" },
    { "#for (I, 3, 1, -1) #debug concat(str(I,0,0),\" \") #end #debug concat(str(I,0,1),\"\n\")", "3 2 1 0.0\n" },
    { "#for (I, 3, 1) #debug \"no\n\" #end #debug concat(str(I,0,1),\"\n\")", "3.0\n" },
    { "#for (I, 0, 1, 0.1) #end #debug concat(str(I,0,3),\"\n\")", "1.100\n" },
    { "#for (I,0,2) #declare I=I+1; #debug concat(str(I,0,0),\"\n\") #end", "1\n3\n" },
    { "#for (I,0,2) #for (J,0,1) #debug concat(str(I*10+J,0,0),\" \") #end #end #debug \"\n\"", "0 1 10 11 20 21 \n" },
    { "#while (0) #end #while (0) #if (1) #else #end #end #debug \"z\n\"", "z\n" },
    { "#switch (3) #case (1) #debug \"1\n\" #case (3) #debug \"3\n\" #case (4) #debug \"4\n\" #break #else #debug \"e\n\" #end",
      "3\n4\n" },
    { "#switch (7) #case (1) #debug \"1\n\" #break #else #debug \"else\n\" #end #debug \"end\n\"", "else\nend\n" },
    { "#switch (2.5) #range (1,2) #debug \"12\n\" #break #range (2,3) #debug \"23\n\" #end", "23\n" },
    { "#switch (2) #debug \"before\n\" #case (2) #debug \"two\n\" #break #end", "before\ntwo\n" },
    { "#for (I,0,1) #switch (I) #case (0) #debug \"0\n\" #break #case (1) #if (1) #break #end #debug \"1\n\" #end #debug \"x\n\" #end",
      "0\nx\nx\n" },
    { "#if (1) #debug \"x\n\" #break #end", "" },
    { "#if (defined(image_width) & !defined(Zip)) #debug \"ok\n\" #end", "ok\n" },
    { "#debug concat(\"a\", #if (1) \"b\" #else \"c\" #end, \"d\n\")", "abd\n" },
    { "#if (1) #declare A = 5; #end #debug concat(str(A,0,0),\"\n\") // a comment # with a hash\n", "5\n" },
};

static const Row macros[] = {
    { "#macro M(A) A*2 #end #debug concat(str(M(2)*M(3),0,0),\" \",str(M(1+2)+1,0,0),\"\n\")", "24 7\n" },
    { "#macro F(N) #if (N<=1) 1 #else N*F(N-1) #end #end #declare X=(F(5)); #debug concat(str(X,0,0),\"\n\")", "120\n" },
    { "#macro F(N) #if (N<=1) 1 #else 2 #end #end #declare V=<F(1),F(2),0>; #debug concat(vstr(3,V,\",\",0,0),\"\n\")", "1,2,0\n" },
    { "#declare A=1; #macro M() #local A=2; N() #end #macro N() #debug str(A,0,0) #declare A=3; #debug str(A,0,0) #end M()"
      "#debug concat(str(A,0,0),\"\n\")", "231\n" },
    { "#macro M(P) #local P=P+1; #end #declare X=1; M(X) #debug concat(str(X,0,0),\"\n\")", "2\n" },
    { "#declare V=<1,2,3>; #macro M(P) #declare P=P+1; #debug str(P,0,0) #end M(V.x) #debug concat(vstr(3,V,\",\",0,0),\"\n\")",
      "21,2,3\n" },
    { "#macro M(A B) #debug concat(str(A,0,0),str(B,0,0),\"\n\") #end #declare X=1; #declare Y=2; M(X Y) M(3 4)", "12\n34\n" },
    { "#macro Swap(A,B) #local T=A; #declare A=B; #declare B=T; #end #declare P=1; #declare Q=2; Swap(P,Q)"
      "#debug concat(str(P,0,0),str(Q,0,0),\"\n\")", "21\n" },
    { "#macro M() #debug \"a\n\" #break #debug \"b\n\" #end M() #debug \"c\n\"", "a\nc\n" },
    { "#macro M() #while (1) #break #end #debug \"b\n\" #end M()", "b\n" },
    { "#macro M() #debug \"one\n\" #end #macro M() #debug \"two\n\" #end M()", "two\n" },
    { "#macro Outer() #macro Inner() #debug \"inner\n\" #end #end Outer() Inner()", "inner\n" },
    { "#macro M(A) #undef A #ifdef (A) #debug \"def\n\" #else #debug \"undef\n\" #end #end #declare Q=1; M(Q) #ifdef (Q) #debug \"Q\n\" #end",
      "undef\nQ\n" },
    { "#macro M() #declare NewG=3; #local NewL=4; #end M() #debug concat(str(NewG,0,0),\"\n\") #ifdef (NewL) #debug \"NewL\n\" #end",
      "3\n" },
    { "#macro P(A) #local R=A*2; R #end #declare X = P(3) + P(4); #debug concat(str(X,0,0),\"\n\")", "14\n" },
    { "#macro R(N) #if (N>0) R(N-1) #end #end R(90) #debug \"ok\n\"", "ok\n" },
    { "#macro S() \"text\" #end #declare T = S(); #debug concat(T,S(),\"\n\")", "texttext\n" },
    { "#macro S() #local X = \"inner\"; X #end #local X = S(); #debug concat(X,\"\n\")", "inner\n" },
    { "#macro S(C) #if (C) \"yes\" #else \"no\" #end #end #local X = S(1); #local Y = S(0); #debug concat(X,Y,\"\n\")", "yesno\n" },
    { "#declare A = array[2]{1,2} #macro M(Q) #declare Q[0]=5; #end M(A) #macro N(Q) #declare Q=7; #end N(A[1])"
      "#debug concat(str(A[0],0,0),str(A[1],0,0),\"\n\")", "57\n" },
    { "#macro M() 2 #end #for (I,0,1) #declare X = M()*M()+I; #debug concat(str(X,0,0),\" \") #end #debug \"\n\"", "4 5 \n" },
    { "#for (I,1,2) #macro M() I #end #debug concat(str(M(),0,0),\" \") #end #debug \"\n\"", "1 2 \n" },
};

/* Odd, but what the tokens say. */
static const Row odd[] = {
    { "#macro M() #declare X = #end #macro N() M() 5; #end N() #debug concat(str(X,0,0),\"\n\")", "5\n" },
    { "#declare A=array[2]{1,2} #declare A[0] = (#declare A=5; 7); #debug \"ok\n\"", "ok\n" },
    { "#macro M(P) #undef Q #declare P=5; #debug concat(str(P,0,0),\"\n\") #end #declare Q=1; M(Q)", "5\n" },
    { "#macro M(P) #declare C=array[1]{9} #declare P=5; #debug concat(str(P,0,0),\"\n\") #end #declare C=array[2]{1,2} M(C[1])", "5\n" },
    { "#declare A=array[1] #declare A[0]=A; #declare A[0]=A; #declare A=A[0]; #debug \"ok\n\"", "ok\n" },
    { "#macro M(P) #declare P=array[2]{P,P} #debug \"ok\n\" #end #declare A=1; M(A)", "ok\n" },
    { "#macro M() #macro M() #debug \"new\n\" #end #debug \"old\n\" #end M() M()", "old\nnew\n" },
    { "#macro M(A,A) #debug concat(str(A,0,0),\"\n\") #end M(1,2) #ifdef (A) #debug \"A\n\" #end", "2\n" },
    { "#declare B = #while (0) #end 5; #debug concat(str(B,0,0),\"\n\")", "5\n" },
    { "#declare C = (#for (I,0,2) #declare J=I; #end J); #debug concat(str(C,0,0),\"\n\")", "2\n" },
    { "#declare C = vlength(<#if (1) 3 #else 4 #end, 4, 0>); #debug concat(str(C,0,0),\"\n\")", "5\n" },
};

static const Row values[] = {
    { "#declare A=1; #undef A #ifdef (A) #debug \"still\n\" #else #debug \"gone\n\" #end", "gone\n" },
    { "#declare A=1; #declare A=\"str\"; #debug A #declare A=<1,2>; #debug concat(str(A.v,0,0),\"\n\")", "str2\n" },
    { "#declare A=1;; #debug \"ok\n\"", "ok\n" },
    { "#declare A = array[2]{1,2} #declare B=A; #declare B[0]=9; #debug concat(str(A[0],0,0),str(B[0],0,0),\"\n\")", "19\n" },
    { "#declare A = array[2] #declare A[0]=1; #ifdef (A[0]) #debug \"0\" #end #ifdef (A[1]) #debug \"1\" #end #undef A[0]"
      "#ifdef (A[0]) #debug \"0\" #end #debug \"\n\"", "0\n" },
    { "#declare A = array[2] #declare A[0]=array[2]{1,2} #declare A[1]=array[3]{3,4,5} #declare A[1][2]=6;"
      "#debug concat(str(A[0][1]+A[1][2],0,0),\" \",str(dimension_size(A[1],1),0,0),\"\n\")", "8 3\n" },
    { "#declare A = array[2][2]{{1,2}{3,4}}; #debug concat(str(A[1][0],0,0),\"\n\")", "3\n" },
    { "#declare A = array[2]{1,2}; #declare A = array[1]{A[1]}; #debug concat(str(A[0],0,0),\"\n\")", "2\n" },
    { "#declare S=\"x\"; #for (I,1,5) #declare S=concat(S,S); #end #debug concat(str(strlen(S),0,0),\"\n\")", "32\n" },
    { "#declare S=spline{linear_spline 0,<0,0> 1,<1,2>} #declare T=S; #debug concat(vstr(2,T(.5),\",\",0,2),\"\n\")", "0.50,1.00\n" },
    { "#declare S=spline{0,<0,0> 1,<1,2>} #declare U=spline{S 2,<5,5>} #debug concat(vstr(2,U(1.5),\",\",0,2),\"\n\")", "3.00,3.50\n" },
    { "#declare W=spline{0,1 1,3} #debug concat(vstr(2,W(.5),\",\",0,2),\"\n\")", "2.00,2.00\n" },
    { "#declare C=rgb 0.1; #debug concat(str(C.red,0,15),\"\n\")", "0.100000001490116\n" },
    { "#version unofficial 3.6; #debug concat(str(version,0,2),\" \") #version version; #debug concat(str(version,0,2),\"\n\")",
      "3.60 3.60\n" },
    { "#version 3.1; #declare A=1 #declare B=2 #debug concat(str(A+B,0,0),\"\n\")", "3\n" },
    { "/* a /* nested */ comment */ #debug \"\\u0041\\\"\\n\"", "A\"\n" },
    { "#declare S=\"\\u00e9\\u20ac\"; #debug concat(str(strlen(S),0,0),\" \",str(asc(S),0,0),\" \",str(asc(substr(S,2,1)),0,0),\"\n\")",
      "2 233 8364\n" },
    { "#render \"hi\n\" #statistics \"ho\n\"", "hi\nho\n" },
    { "#debug \"held \" #debug \"back\n\"", "held back\n" },
    { "#debug concat(input_file_name,\"\n\")", "scene.pov\n" },
    { "# declare A=1; # /* x */ debug concat(str(A,0,0),\"\n\")", "1\n" },
};

static int check(const Row *row, size_t n)
{
    int bad = 0;
    for (size_t i = 0; i < n; i++) {
        Run r;
        bool fine = run(&r, row[i].text);
        bool expected_error = row[i].said[0] == 0;
        if (fine == expected_error || (fine && strcmp(r.debug, row[i].said) != 0)) {
            print_message("%s\n  said \"%s\", expected \"%s\"\n  %s\n", row[i].text, r.debug, row[i].said, r.messages);
            bad++;
        }
        run_end(&r);
    }
    return bad;
}

static void conditionals_and_loops_run_as_in_povray(void **state)
{
    (void)state;
    assert_int_equal(check(flow, sizeof flow / sizeof *flow), 0);
}

static void macros_replace_tokens_and_pass_identifiers_by_reference(void **state)
{
    (void)state;
    assert_int_equal(check(macros, sizeof macros / sizeof *macros), 0);
}

static void odd_but_legal_orders_are_kept(void **state)
{
    (void)state;
    assert_int_equal(check(odd, sizeof odd / sizeof *odd), 0);
}

static void values_are_declared_copied_and_removed(void **state)
{
    (void)state;
    assert_int_equal(check(values, sizeof values / sizeof *values), 0);
}

/* The same statements as a file, as the body of a loop, and as the body of a macro: read from text, replayed from tokens. */
static void replayed_tokens_do_what_the_text_does(void **state)
{
    (void)state;
    static const Row *const tables[] = { flow, values };
    static const size_t sizes[] = { sizeof flow / sizeof *flow, sizeof values / sizeof *values };
    for (int t = 0; t < 2; t++)
        for (size_t i = 0; i < sizes[t]; i++) {
            if (tables[t][i].said[0] == 0)
                continue;
            char text[4096];
            Run r;
            snprintf(text, sizeof text, "#for (Round_, 1, 1) %s #end", tables[t][i].text);
            run(&r, text);
            assert_string_equal(r.debug, tables[t][i].said);
            run_end(&r);
            snprintf(text, sizeof text, "#macro M_() %s #end M_()", tables[t][i].text);
            run(&r, text);
            assert_string_equal(r.debug, tables[t][i].said);
            run_end(&r);
        }
}

static void a_utf8_mark_at_the_start_says_how_strings_are_written(void **state)
{
    (void)state;
    static const Row rows[] = {
        { "\xef\xbb\xbf#declare S=\"\xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80\"; #debug concat(str(strlen(S),0,0),\" \",str(asc(S),0,0),\"\n\")", "3 233\n" },
        { "#declare S=\"\xc3\xa9\"; #debug concat(str(strlen(S),0,0),S,\"|\n\")", "2  |\n" },
        { "#version 3.1; #declare S=\"\xc3\xa9\" #debug concat(str(asc(S),0,0),\"\n\")", "195\n" },
    };
    assert_int_equal(check(rows, sizeof rows / sizeof *rows), 0);
}

/* What the command line gives: numbers with six digits, the clock in single precision, the first of two declarations. */
static void options_are_seen_by_the_scene(void **state)
{
    (void)state;
    static const SdlDeclare declare[] = {
        { { "A", 1 }, { "1.23456789", 10 }, false }, { { "Text", 4 }, { "some text", 9 }, true }, { { "A", 1 }, { "2", 1 }, false },
        { { "Minus", 5 }, { "-1e10", 5 }, false }, { { "sphere", 6 }, { "1", 1 }, false },
    };
    SdlOptions options = { .width = 320, .height = 240, .version = 350, .clock = 0.123456789, .clock_on = true, .frame_number = 7,
                           .strict = true, .declare = declare, .n_declares = 5, .input_name = str_of("a/b.pov") };
    Run r;
    assert_true(run_options(&r, "#debug concat(str(A,0,9),\" \",Text,\" \",str(Minus,0,0),\" \",str(clock,0,9),\" \",str(clock_on,0,0),\" \","
                                "str(version,0,2),\" \",str(frame_number,0,0),\" \",str(image_width,0,0),\" \",input_file_name,\"\n\")",
                            &options));
    assert_string_equal(r.debug, "1.234570000 some text -10000000000 0.123456791 1 3.50 7 320 b.pov\n");
    run_end(&r);
}

static void numbers_declared_in_a_loop_take_no_memory(void **state)
{
    (void)state;
    Run r;
    size_t used[2];
    for (int k = 0; k < 2; k++) {
        char text[512];
        snprintf(text, sizeof text,
                 "#macro M(A,B) #local V=<A,B,1>*2; #local W=array[2]{A,B} #local X=concat(str(A,0,3),\"x\"); V.x #end"
                 "#declare S=0; #declare T=\"\"; #for (I,1,%d) #declare S=S+M(I,S); #declare T=str(S,0,3); #end", k ? 20000 : 200);
        assert_true(run(&r, text));
        used[k] = r.arena.used;
        run_end(&r);
    }
    assert_true(used[1] < used[0] + 4096);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(conditionals_and_loops_run_as_in_povray),
        cmocka_unit_test(macros_replace_tokens_and_pass_identifiers_by_reference),
        cmocka_unit_test(odd_but_legal_orders_are_kept),
        cmocka_unit_test(values_are_declared_copied_and_removed),
        cmocka_unit_test(replayed_tokens_do_what_the_text_does),
        cmocka_unit_test(a_utf8_mark_at_the_start_says_how_strings_are_written),
        cmocka_unit_test(options_are_seen_by_the_scene),
        cmocka_unit_test(numbers_declared_in_a_loop_take_no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
