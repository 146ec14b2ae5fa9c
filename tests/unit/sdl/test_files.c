/* test_files.c - includes, #fopen, #read and #write, in a folder of their own; and what lies outside it stays untouched. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include "sdl/run.h"

static char home[4096], folder[4096];

static int enter(void **state)
{
    (void)state;
    snprintf(folder, sizeof folder, "%s/whit-files-XXXXXX", getenv("TMPDIR") ? getenv("TMPDIR") : "/tmp");
    return !getcwd(home, sizeof home) || !mkdtemp(folder) || chdir(folder) != 0;
}

static int leave(void **state)
{
    (void)state;
    char command[5000];
    snprintf(command, sizeof command, "rm -rf '%s'", folder);
    return chdir(home) != 0 || system(command) != 0;
}

static void put(const char *name, const char *text)
{
    FILE *f = fopen(name, "wb");
    assert_non_null(f);
    fputs(text, f);
    fclose(f);
}

static size_t get(const char *name, char *out, size_t size)
{
    FILE *f = fopen(name, "rb");
    assert_non_null(f);
    size_t n = fread(out, 1, size - 1, f);
    out[n] = 0;
    fclose(f);
    return n;
}

static void says(const char *text, const char *expected)
{
    Run r;
    bool fine = run(&r, text);
    if (!fine)
        print_message("%s\n%s", text, r.messages);
    assert_true(fine);
    assert_string_equal(r.debug, expected);
    run_end(&r);
}

static void refuses(const char *text, const char *message)
{
    Run r;
    assert_false(run(&r, text));
    if (!strstr(r.messages, message))
        print_message("%s\n%s", text, r.messages);
    assert_non_null(strstr(r.messages, message));
    run_end(&r);
}

static void includes_have_names_of_their_own_and_find_their_extension(void **state)
{
    (void)state;
    put("a.inc", "#local Inner = 5; #declare Outer = 6; #debug \"in a\n\"");
    put("open.inc", "#if (1)\n");
    put("close.inc", "#debug \"closing\n\" #end\n");
    put("macro.inc", "#macro FromInclude(A) #debug concat(\"got \",str(A,0,0),\"\n\") #end\n");
    put("deep.inc", "#declare Depth=Depth+1; #if (Depth<Most) #include \"deep.inc\" #end\n");
    put("loop.inc", "#while (1)\n");
    says("#include \"a\" #ifdef (Inner) #debug \"Inner\n\" #end #debug concat(str(Outer,0,0),\"\n\")", "in a\n6\n");
    says("#include \"open.inc\" #debug \"x\n\" #end #debug \"y\n\"", "x\ny\n");
    says("#if (1) #debug \"x\n\" #include \"close.inc\" #debug \"y\n\"", "x\nclosing\ny\n");
    says("#include \"macro.inc\" FromInclude(2)", "got 2\n");
    says("#for (I,0,2) #include \"a.inc\" #end", "in a\nin a\nin a\n");
    says("#declare Depth=0; #declare Most=31; #include \"deep.inc\" #debug concat(str(Depth,0,0),\"\n\")", "31\n");
    refuses("#declare Depth=0; #declare Most=40; #include \"deep.inc\"", "Too many nested include files.");
    refuses("#include \"loop.inc\" #end", "#while loop did not end in file where it started.");
    refuses("\n\n  #include \"broken\"", "scene.pov:3:3");
}

static void mistakes_in_includes_tell_the_way(void **state)
{
    (void)state;
    put("inner.inc", "#macro Bad()\n  #declare X = ;\n#end\n");
    put("outer.inc", "// one line\n#include \"inner.inc\"\nBad()\n");
    refuses("#include \"outer.inc\"",
            "inner.inc:2:16: error: Expected 'RValue to declare', ; found instead\n    #declare X = ;\n                 ^\n"
            "  in macro Bad called at outer.inc:3:1\n  in outer.inc included at scene.pov:1:1");
}

static void data_is_read_until_the_end(void **state)
{
    (void)state;
    put("data.txt", "1, 2.5, -3, // comment\n<1,-2,3>, \"str\", 7");
    put("blank.txt", "1 -2 3\n<1,2> 4");
    put("comma.txt", "1, 2,");
    put("empty.txt", " /* nothing */ ");
    put("wrong.txt", "1+2 3*4");
    says("#fopen H \"data.txt\" read #read (H,A,B,C,V,S,D)"
         "#debug concat(str(A,0,2),\" \",str(B,0,2),\" \",str(C,0,2),\" \",vstr(3,V,\",\",0,0),\" \",S,\" \",str(D,0,1),\"\n\")"
         "#ifdef (H) #debug \"open\n\" #else #debug \"closed\n\" #end", "1.00 2.50 -3.00 1,-2,3 str 7.0\nclosed\n");
    says("#fopen H \"blank.txt\" read #declare N=0; #while (defined(H)) #read (H,A) #declare N=N+1; #end #debug concat(str(N,0,0),\"\n\")",
         "5\n");
    /* POV: a comma with nothing behind it gives one more turn, with the old value. */
    says("#fopen H \"comma.txt\" read #while (defined(H)) #read (H,A) #debug concat(str(A,0,0),\" \") #end #debug \"\n\"", "1 2 2 \n");
    says("#fopen H \"empty.txt\" read #while (defined(H)) #read (H,A) #debug \"turn\n\" #end #ifdef (A) #debug \"A\n\" #end", "turn\n");
    says("#declare B=array[2]{1,2} #fopen H \"blank.txt\" read #read (H,B[1]) #debug concat(str(B[0]+B[1],0,0),\"\n\")", "2\n");
    refuses("#fopen H \"wrong.txt\" read #while (defined(H)) #read (H,A) #end", "wrong.txt:1:6: error: Expected 'float, vector, or string literal'");
    refuses("#fopen H \"data.txt\" read #write (H,\"x\")", "Cannot write to file data.txt because the file is open for reading only.");
    refuses("#declare B=array[2]{\"a\",\"b\"} #fopen H \"data.txt\" read #read (H,B[1])",
            "Attempted to redefine string identifier as float identifier.");
}

static void what_is_written_has_the_form_of_povray(void **state)
{
    (void)state;
    char text[256];
    says("#fopen H \"o.txt\" write #write (H,1,2,\" \",<1,2,3>,\"abc\",1/3,\" \",1e10,\" \",<1.5,2>) #fclose H #fclose Nope", "");
    get("o.txt", text, sizeof text);
    assert_string_equal(text, "12 <1,2,3> abc0.333333 1e+10 <1.5,2> ");
    says("#fopen H \"o.txt\" write #write (H,\"a\n\") #fclose H #fopen H \"o.txt\" append #write (H,\"b\n\") #fclose H", "");
    get("o.txt", text, sizeof text);
    assert_string_equal(text, "a\nb\n");
    says("#fopen H \"o.txt\" write #write (H,\"\\u00e9|\\u20ac|\") #fclose H", "");
    get("o.txt", text, sizeof text);
    assert_string_equal(text, " | |");
    says("#fopen H \"o.bin\" write #write (H,sint8 1 -2,sint8 -2 200,uint16be 258 70000,sint32le -5,uint8 65.5,uint8 -1) #fclose H", "");
    assert_int_equal(get("o.bin", text, sizeof text), 13);
    assert_memory_equal(text, "\xff\xfe\x7f\x01\x02\xff\xff\xfb\xff\xff\xff\x42\x00", 13);
    refuses("#fopen H \"o.txt\" write #read (H,A)", "Cannot read from file o.txt because the file is open for writing only.");
}

static void what_was_written_can_be_read_back(void **state)
{
    (void)state;
    says("#fopen H \"o.txt\" write #for (I,1,3) #write (H,I,\",\",<I,I*2,-I>,\",\n\") #end #fclose H"
         "#fopen H \"o.txt\" read #for (I,1,3) #read (H,A,V) #debug concat(str(A,0,0),\":\",vstr(3,V,\" \",0,0),\" \") #end #debug \"\n\"",
         "1:1 2 -1 2:2 4 -2 3:3 6 -3 \n");
    char text[64];
    says("#fopen H \"o.txt\" write #for (I,1,2) #write (H \"abc\" \"de\" I \"f\n\") #end #fclose H", "");
    get("o.txt", text, sizeof text);
    assert_string_equal(text, "abcde1f\nabcde2f\n");
}

static void nothing_outside_the_folders_is_touched(void **state)
{
    (void)state;
    put("secret.txt", "1");
    assert_int_equal(mkdir("below", 0777), 0);
    assert_int_equal(chdir("below"), 0);
    assert_int_equal(symlink("../secret.txt", "link.txt"), 0);
    assert_int_equal(symlink("..", "up"), 0);
    assert_int_equal(link("../secret.txt", "hard.txt"), 0);
    assert_int_equal(mkfifo("pipe", 0666), 0);
    put("mine.txt", "1");
    says("#fopen H \"mine.txt\" read #read (H,A) #fopen H \"./mine.txt\" write", "");
    refuses("#fopen H \"../secret.txt\" read", "outside the folders");
    refuses("#fopen H \"link.txt\" read", "outside the folders");
    refuses("#fopen H \"up/secret.txt\" read", "outside the folders");
    refuses("#fopen H \"../secret.txt\" write", "outside the folders");
    refuses("#fopen H \"link.txt\" write", "outside the folders");
    refuses("#fopen H \"hard.txt\" write", "outside the folders");
    refuses("#fopen H \"up/secret.txt\" append", "outside the folders");
    refuses("#fopen H \"up/new.txt\" write", "outside the folders");
    refuses("#fopen H \"pipe\" read", "Cannot find file");
    refuses("#fopen H \".\" read", "Cannot find file");
    refuses("#fopen H \"no such folder/x\" write", "there is no such file");
    refuses("#include \"../secret.txt\"", "outside the folders");
    says("#if (file_exists(\"../secret.txt\")) #debug \"seen\n\" #else #debug \"unseen\n\" #end", "unseen\n");
    Run r;
    Str up = str_of("..");
    SdlOptions options = { .strict = true, .allow_read = &up, .n_allow_read = 1 };
    assert_true(run_options(&r, "#fopen H \"../secret.txt\" read", &options));
    run_end(&r);
    options = (SdlOptions){ .strict = true, .allow_write = &up, .n_allow_write = 1 };
    assert_true(run_options(&r, "#fopen H \"../new.txt\" write", &options));
    run_end(&r);
    char text[16];
    get("../secret.txt", text, sizeof text);
    assert_string_equal(text, "1");
    assert_int_equal(chdir(".."), 0);
}

/* A scene that came from another system: its includes are there, but for the case of letters. */
static void files_are_found_in_other_letters_with_a_warning(void **state)
{
    (void)state;
    put("Colours.inc", "#debug \"found\n\"");
    SdlOptions options = { .width = 8 };
    Run r;
    assert_true(run_options(&r, "#include \"colours.INC\"", &options));
    assert_string_equal(r.debug, "found\n");
    assert_non_null(strstr(r.messages, "warning: there is no 'colours.INC': 'Colours.inc' is used"));
    run_end(&r);
    refuses("#include \"colours.INC\"", "Cannot open include file colours.INC.");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(includes_have_names_of_their_own_and_find_their_extension),
        cmocka_unit_test(mistakes_in_includes_tell_the_way),
        cmocka_unit_test(data_is_read_until_the_end),
        cmocka_unit_test(what_is_written_has_the_form_of_povray),
        cmocka_unit_test(what_was_written_can_be_read_back),
        cmocka_unit_test(nothing_outside_the_folders_is_touched),
        cmocka_unit_test(files_are_found_in_other_letters_with_a_warning),
    };
    return cmocka_run_group_tests(tests, enter, leave);
}
