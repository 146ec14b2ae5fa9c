/* test_errors.c - each mistake has its message, at its line, and nothing crashes. The words are povray's where it has any. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include <stdlib.h>

#include "sdl/run.h"

typedef struct Row { const char *text, *message; } Row;

static const Row rows[] = {
    { "#declare B = 1 < 2;", "scene.pov:1:16: error: All #declares of float, vector, and color require semi-colon" },
    { "#declare A = 1\n#debug \"x\"", "scene.pov:2:1: error: All #declares" },
    { "#declare A = 1;;;", "error: Expected 'object or directive', ; found instead" },
    { ";", "scene.pov:1:1: error: Expected 'object or directive', ; found instead" },
    { "#declare sphere = 1;", "error: Expected 'undeclared identifier', sphere found instead" },
    { "#macro M() #end\n#declare M = 1;", "scene.pov:2:10: error: Expected 'undeclared identifier', macro identifier found instead" },
    { "#declare M = 1; #macro M() #end", "error: Expected 'undeclared identifier', float function 'float identifier' found instead" },
    { "#declare A = Nope;", "error: Cannot assign uninitialized identifier." },
    { "#declare Radius = 1; #debug str(Radios,0,0)",
      "error: Expected 'numeric expression', undeclared identifier 'Radios' (did you mean 'Radius'?) found instead" },
    { "#declare A 1;", "error: Expected '=', float function 'float constant' found instead" },
    { "#undef sphere", "error: Expected 'undeclared identifier', sphere found instead" },
    { "#macro F(N) #if (N<=1) 1 #else 2 #end #end\n#declare V=F(1);", "error: All #declares" },
    { "#macro F(N) #if (N<=1) 1 #else 2 #end #end\n#if (F(2)=2) #end", "error: Expected ')', # found instead" },
    { "#macro M(A,B) A #end #debug str(M(1),0,0)", "error: Expected 2 parameters but only 1 found." },
    { "#macro M(A) A #end #debug str(M(1,2),0,0)", "error: Expected ')', float function 'float constant' found instead" },
    { "#macro M(A) A #end #debug str(M(Undef),0,0)", "error: Cannot pass uninitialized identifier as macro parameter." },
    { "#macro M(A,5) #end", "error: Expected 'identifier or expression.', float function 'float constant' found instead" },
    { "#macro M(A", "error: Expected 'identifier or expression.', End of File found instead" },
    { "#macro Broken()\n  #declare X = 1/;\n#end\nBroken()",
      "scene.pov:2:18: error: Expected 'numeric expression', ; found instead\n"
      "    #declare X = 1/;\n                   ^\n  in macro Broken called at scene.pov:4:1" },
    { "#macro M(A,B) #end\nM(\n\n1,\n2)\nM(\n<1,2>\n,\n\"x\")\n;", "scene.pov:10:1: error: Expected 'object or directive', ; found" },
    { "#macro R(N) #if (N>0) R(N-1) #end #end R(200)", "error: Too many nested" },
    { "#macro R() (R()) #end #declare A=R();", "error: " },
    { "#macro R() #local A=R(); #end R()", "error: " },
    { "#for #end", "error: Expected '(', # found instead" },
    { "#while ((#end 0))", "error: Mis-matched '#end'." },
    { "#while ((#break 0)) #end", "error: Invalid context for #break" },
    { "#while (1) #if ((#break 1)) #end #end", "error: Invalid context for #break" },
    { "#if ((#else 1)) #end", "error: Mis-matched '#else'." },
    { "#switch (1) #case ((#end 1)) #end", "error: Mis-matched '#end'." },
    { "#for (I,(#end 1),2) #end", "error: Mis-matched '#end'." },
    { "#macro M() 0) #debug \"x\" #end #if (M() #else #end", "error: " },
    { "#macro N() #macro M() 0) #debug \"x\" #end #if (M() #end #end N()", "parentheses of a directive must end in the file or macro" },
    { "#macro M() #case (1) #end #switch (1) M() #end", "error: #switch not followed by #case or #range." },
    { "#macro M() #undef M #end M() M()", "error: Expected 'object or directive', undeclared identifier 'M' found instead" },
    { "#declare A=array[2]{1,2} #declare B=A[ #undef A 1 ];", "error: Array subscript out of range" },
    { "#declare A=array[2]{1,2} #declare A[ (#undef A 1) ] = 5;", "error: Array subscript out of range" },
    { "#break", "error: Invalid context for #break" },
    { "#switch (7) sphere #case (1) #end", "error: #switch not followed by #case or #range." },
    { "#for (I, 3, 1, 0) #end", "error: #for loop increment must be non-zero." },
    { "#for (5, 3, 1) #end", "error: expected the name of a variable" },
    { "#if (0) #else #else #end", "error: Mis-matched '#else'." },
    { "#end", "error: Mis-matched '#end'." },
    { "#else", "error: Mis-matched '#else'." },
    { "#if (1)", "scene.pov:1:1: error: End of file reached but #end expected." },
    { "#if (0)", "error: End of file reached but #end expected." },
    { "#while (1)", "error: End of file reached but #end expected." },
    { "#ifdef X #end", "error: Expected '(', undeclared identifier 'X' (did you mean 'x'?) found instead" },
    { "#if 1 #end", "error: Expected '(', float function 'float constant' found instead" },
    { "#include \"nothere.inc\"", "error: Cannot open include file nothere.inc." },
    { "#include 5", "error: Expecting a string after INCLUDE." },
    { "#declare A = array[3] #declare A[0]=1; #declare A[1]=<1,2,3>;",
      "error: Attempted to redefine float identifier as vector identifier." },
    { "#declare A = array[3] {1,2}", "error: Expected 'RValue to declare', } found instead" },
    { "#declare A = array[3] {1,2,3,4}", "error: No matching } in '{', float function 'float constant' found instead" },
    { "#declare A = array[2] #debug str(A[0],0,0)", "error: Attempt to access uninitialized array element." },
    { "#declare A = array[2]{1,2} #debug str(A[2],0,0)", "error: Array subscript out of range" },
    { "#declare A = array[2]{1,2} #debug str(A[-1],0,0)", "error: Negative subscript" },
    { "#declare A = array[2]{1,2} #for (I,0,5) #declare B=A[I]; #end", "error: Array subscript out of range" },
    { "#declare A = array[0]", "error: Invalid dimension size for an array" },
    { "#declare A = array[1e9]", "error: an array can have at most" },
    { "#declare A = array[60000][60000]", "error: an array can have at most" },
    { "#declare A = array[1][1][1][1][1][1]", "error: Too many array dimensions" },
    { "#declare A=array[2][2]{{1,2},{3,4}} #debug str(A[1],0,0)", "error: Expected '[', ,  found instead" },
    { "#declare A=5; #declare A[0]=1;", "error: Expected '=', [ found instead" },
    { "#declare S = spline { }", "error: Spline must have at least one entry." },
    { "#error \"bad thing\"", "error: Parse halted by #error directive: bad thing" },
    { "#version 3.8;", "error: Your scene file requires POV-Ray version 3.8 or later!" },
    { "#debug \"a\\qb\n\"", "error: Illegal escape sequence in string." },
    { "#debug \"a\\u12x\"", "error: Illegal escape sequence in string." },
    { "#debug \"a\\\nb\"", "error: Unterminated string literal." },
    { "#debug \"a", "error: No end quote for string." },
    { "#if (0) \"unbalanced #end", "error: No end quote for string." },
    { "#if (0) 1.2.3 #end", "error: Unexpected additional '.' in floating-point number" },
    { "#declare X = 1.2.3;", "error: Unexpected additional '.' in floating-point number" },
    { "/* unclosed /* */", "error: No */ closing comment found." },
    { "#if (0) \x01 #end", "error: Illegal character in input file, value is 01." },
    { "#declare \xc3\xa9 = 1;", "error: Illegal character in input file, value is c3." },
    { "#debug str(sqrt(-1),0,0)", "error: sqrt of negative number -1.000000" },
    { "#debug str(ln(0),0,0)", "error: ln of negative number 0.000000" },
    { "#debug str(pow(0,0),0,0)", "error: Domain error." },
    { "#debug str(atan2(0,0),0,0)", "error: Domain error in atan2!" },
    { "#debug substr(\"abc\",2,3)", "error: Illegal parameters in substr." },
    { "#debug substr(\"abc\",-1,1)", "error: Illegal parameters in substr." },
    { "#debug chr(-1)", "error: Value -1 cannot be used in chr(...)." },
    { "#debug str(rand(0),0,5)", "error: Illegal random number generator." },
    { "#debug datetime(0,\"\")", "error: Empty format string." },
    { "#debug str(inside(5,x),0,0)", "error: Object identifier expected." },
    { "#debug str(<1,2,3>,0,0)", "error: Float expected but vector or color expression found." },
    { "#debug str(vdot(<1,2,3,4>,x),0,0)", "error: Vector expected but color expression found." },
    { "#declare V=<1,2,3,4,5,6>;", "error: Expected '>', ,  found instead" },
    { "#declare V=<1>;", "error: Expected 'numeric expression', > found instead" },
    { "#declare V=<1,2>; #declare W=V.z;", "error: Bad operands for period operator." },
    { "#declare C = srgb 1;", "error: Cannot parse sRGB colors before assumed_gamma has been set." },
    { "#debug 5", "error: Expected 'string expression', float function 'float constant' found instead" },
    { "#fopen H \"no such file\" read", "error: Cannot find file 'no such file'." },
    { "#fopen H \"/etc/passwd\" read", "error: Cannot open file '/etc/passwd': it lies outside" },
    { "#fopen H \"../../../../../../../../etc/passwd\" read", "outside the folders this scene may use" },
    { "#fopen H \"/tmp/whit-must-not-be-written\" write", "outside the folders this scene may use" },
    { "#fopen H \"/dev/null\" write", "outside the folders this scene may use" },
    { "#read (Nope, A)", "error: Expected 'file identifier', undeclared identifier 'Nope' found instead" },
};

static void each_mistake_has_its_message(void **state)
{
    (void)state;
    int bad = 0;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        Run r;
        if (run(&r, rows[i].text) || !strstr(r.messages, rows[i].message)) {
            print_message("%s\n  expected \"%s\"\n  got \"%s\"\n", rows[i].text, rows[i].message, r.messages);
            bad++;
        }
        run_end(&r);
    }
    assert_int_equal(bad, 0);
}

/* Line ends of all kinds count once; so the mistake is on the line where an editor shows it. */
static void every_line_end_counts_once(void **state)
{
    (void)state;
    static const char *const ends[] = { "\n", "\r", "\r\n", "\n\r" };
    for (int i = 0; i < 4; i++) {
        char text[256];
        Run r;
        snprintf(text, sizeof text, "// one%s/* two%s three */%s\"x%sy\"", ends[i], ends[i], ends[i], ends[i]);
        assert_false(run(&r, text));
        assert_non_null(strstr(r.messages, "scene.pov:4:1: error"));
        run_end(&r);
    }
}

static char *repeated(const char *before, const char *part, int n, const char *middle, const char *end)
{
    size_t size = strlen(before) + strlen(part) * (size_t)n + strlen(middle) + strlen(end) * (size_t)n + 2;
    char *text = malloc(size), *at = text + sprintf(text, "%s", before);
    for (int i = 0; i < n; i++)
        at += sprintf(at, "%s", part);
    at += sprintf(at, "%s", middle);
    for (int i = 0; i < n; i++)
        at += sprintf(at, "%s", end);
    return text;
}

static void nesting_without_end_is_refused_and_does_not_crash(void **state)
{
    (void)state;
    static const struct { const char *before, *part, *middle, *end; } deep[] = {
        { "#declare A=", "(", "1", ")" }, { "#declare A=", "-", "1;", "" }, { "#declare A=", "!", "1;", "" },
        { "#declare A=", "<", "1", ",1>" }, { "#declare A=", "sin(", "1", ")" }, { "#debug ", "concat(", "\"\"", ")" },
        { "#for (I,0,1) #declare A=", "(", "1", ")" }, { "#declare A=", "(1?", "1", ":1)" }, { "", "#if (1) ", "", "#end " },
        { "", "#while (1) ", "#break", "#end " }, { "", "#switch (1) #case (1) ", "", "#end " },
        { "", "#macro M() ", "", "#end " }, { "#declare A=", "array[1]{", "1", "}" }, { "#declare A=", "max(1,", "1", ")" },
        { "#declare A=array[1]{0} #declare B=", "A[", "0", "]" },
    };
    for (size_t i = 0; i < sizeof deep / sizeof *deep; i++) {
        char *text = repeated(deep[i].before, deep[i].part, 100000, deep[i].middle, deep[i].end);
        Run r;
        assert_false(run(&r, text));
        assert_non_null(strstr(r.messages, "error: "));
        run_end(&r);
        free(text);
    }
}

static void comments_nest_to_any_depth(void **state)
{
    (void)state;
    char *text = repeated("", "/* ", 100000, "#error \"inside\"", "*/");
    Run r;
    assert_true(run(&r, text));
    run_end(&r);
    free(text);
}

/* 01-language, section 34: one literal may have 255 characters, not 256. */
static void names_and_strings_have_255_characters_at_most(void **state)
{
    (void)state;
    static const struct { const char *before, *middle, *end; } where[] = { { "#declare ", " = 1;", "" }, { "#debug \"", "\"", "" } };
    for (int i = 0; i < 2; i++)
        for (int n = 255; n <= 256; n++) {
            Run r;
            char *text = repeated(where[i].before, "a", n, where[i].middle, "");
            assert_true(run(&r, text) == (n == 255));
            assert_true(n == 255 || strstr(r.messages, "String too long."));
            run_end(&r);
            free(text);
        }
}

static void a_parse_that_should_stop_stops(void **state)
{
    (void)state;
    volatile int stop = 1;
    SdlOptions options = { .strict = true, .stop = &stop };
    Run r;
    assert_false(run_options(&r, "#while (1) #declare A = 1; #end", &options));
    assert_non_null(strstr(r.messages, "error: stopped"));
    run_end(&r);
}

static const Row mended[] = {
    { "#declare A = 1 #debug concat(str(A,0,0),\"\n\") #declare B = 2 #debug concat(str(B,0,0),\"\n\")", "1\n2\n" },
    { "#declare A = <1,2,3>\n#declare B = A.y\n#for (I,0,1) #declare C = B+I #end #debug concat(str(C,0,0),\"\n\")", "3\n" },
    { "#if (1) #declare A = 4 #else #declare A = 5 #end #debug concat(str(A,0,0),\"\n\")", "4\n" },
};

/* Without strictness, what can only mean one thing is supplied, with one warning however often. */
static void missing_semicolons_are_mended_with_one_warning(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof mended / sizeof *mended; i++) {
        SdlOptions options = { .width = 8, .height = 8 };
        Run r;
        assert_true(run_options(&r, mended[i].text, &options));
        assert_string_equal(r.debug, mended[i].message);
        const char *first = strstr(r.messages, "require semi-colon");
        assert_non_null(first);
        assert_null(strstr(first + 1, "require semi-colon"));
        run_end(&r);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_mistake_has_its_message),
        cmocka_unit_test(every_line_end_counts_once),
        cmocka_unit_test(nesting_without_end_is_refused_and_does_not_crash),
        cmocka_unit_test(comments_nest_to_any_depth),
        cmocka_unit_test(names_and_strings_have_255_characters_at_most),
        cmocka_unit_test(a_parse_that_should_stop_stops),
        cmocka_unit_test(missing_semicolons_are_mended_with_one_warning),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
