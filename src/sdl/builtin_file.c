/* builtin_file.c - files of a scene: the library search, #fopen, #read, #write (01-language, section 15). */
#include <math.h>
#include <string.h>

#include "sdl/parser.h"

const char *const FILE_INCLUDE_EXTENSIONS[] = { ".inc", ".INC", NULL };

/* -- The library search -- */

/* A text found before by the same name. */
static FileText *searched(Parser *p, Str name, const char *const *extensions)
{
    for (uint32_t i = 0; i < p->searched.n; i++) {
        const FileSearch *s = &p->searched.data[i];
        if (s->extensions == extensions && str_equal(s->name, name))
            return &p->file.data[s->file];
    }
    return NULL;
}

static Str text_of(Parser *p, FileText *file, uint16_t *source)
{
    if (source && file->source == NO_SOURCE)
        file->source = diag_source(p->diag, file->path, file->text);
    if (source)
        *source = file->source;
    return file->text;
}

typedef struct Search {
    Parser *p;
    bool read;
    FileResult worst;                          /* what stood in the way of a file that exists */
    Str found, text;
} Search;

static FileText *cached(Parser *p, Str path)
{
    for (uint32_t i = 0; i < p->file.n; i++)
        if (str_equal(p->file.data[i].path, path))
            return &p->file.data[i];
    return NULL;
}

static bool try_path(Search *s, Str path)
{
    Parser *p = s->p;
    FileText *known = cached(p, path);
    FileResult result = FILE_OK;
    if (known) {
        s->text = known->text;
    } else if (s->read) {
        result = file_read(p->arena, &p->access, path, &s->text);
        if (result == FILE_OK)
            array_push(p->arena, &p->file, (FileText){ str_copy(p->arena, path), s->text, NO_SOURCE });
    } else {
        result = file_check(&p->temp, &p->access, path);
    }
    if (result == FILE_OK)
        s->found = str_copy(p->arena, path);
    else if (result != FILE_MISSING)
        s->worst = result;
    return result == FILE_OK;
}

/* In the current folder, then in the library, each candidate in turn: as given first if it has an extension of the kind
 * wanted, else with the extensions first. `visit` says what is tried. */
static bool search(Search *s, Str name, const char *const *extensions, bool (*visit)(Search *s, Str folder, Str name))
{
    Parser *p = s->p;
    bool has = !extensions[0];
    for (int i = 0; extensions[i]; i++)
        has |= str_ends_with(name, extensions[i]);
    for (int i = has ? -1 : 0;; i++) {
        bool plain = i < 0 || !extensions[i];
        Str candidate = plain ? name : str_concat(&p->temp, name, str_of(extensions[i]));
        if (!plain || i < 0 || !has) {
            if (visit(s, str_of(""), candidate))
                return true;
            bool absolute = candidate.n && candidate.data[0] == '/';
            for (uint32_t k = 0; k < p->options->n_library_paths && !absolute; k++)
                if (visit(s, p->options->library_path[k], candidate))
                    return true;
        }
        if (i >= 0 && !extensions[i])
            return false;
    }
}

static bool visit_exact(Search *s, Str folder, Str name)
{
    return try_path(s, file_join(&s->p->temp, folder, name));
}

static bool visit_any_case(Search *s, Str folder, Str name)
{
    Str path = file_other_case(&s->p->temp, file_join(&s->p->temp, folder, name));
    return path.n && try_path(s, path);
}

static bool visit_scene_folder(Search *s, Str folder, Str name)
{
    (void)folder;
    return try_path(s, file_join(&s->p->temp, s->p->scene_folder, name));
}

/* What the reference would not find: files beside the scene, and names in other letters. Mended, with a word about it. */
static bool search_kindly(Search *s, Str name, const char *const *extensions, Loc loc)
{
    Parser *p = s->p;
    if (p->options->strict)
        return false;
    if (search(s, name, extensions, visit_scene_folder)) {
        if (p->scene_folder.n)
            warn_once(p->diag, loc, "'%.*s' was found in the folder of the scene, which is not searched by POV-Ray",
                      STR_ARGS(name));
        return true;
    }
    if (!search(s, name, extensions, visit_any_case))
        return false;
    warn_once(p->diag, loc, "there is no '%.*s': '%.*s' is used", STR_ARGS(name), STR_ARGS(s->found));
    return true;
}

/* The text of the file (its path, if it is not to be read), kept for the next time; empty if not found, unless reported. */
Str file_find(Parser *p, Str name, const char *const *extensions, Loc loc, bool report, uint16_t *source, bool read)
{
    Search s = { .p = p, .read = read, .worst = FILE_MISSING };
    FileText *again = read ? searched(p, name, extensions) : NULL;
    if (again)
        return text_of(p, again, source);
    ArenaMark mark = arena_mark(&p->temp);
    bool exact = name.n && search(&s, name, extensions, visit_exact);
    bool found = exact || (name.n && report && search_kindly(&s, name, extensions, loc));
    if (!found && !report)
        return (Str){ 0 };
    if (!found && s.worst != FILE_MISSING)
        fail_io(p->diag, loc, "Cannot open file '%.*s': %s.", STR_ARGS(name), file_result_text(s.worst));
    if (!found && extensions[0]) {
        warn(p->diag, loc, "Cannot find file '%.*s', even after trying to append file type extension.", STR_ARGS(name));
        fail_io(p->diag, loc, "Cannot open include file %.*s.", STR_ARGS(name));
    }
    if (!found)
        fail_io(p->diag, loc, "Cannot find file '%.*s'.", STR_ARGS(name));
    arena_rewind(&p->temp, mark);
    if (!read)
        return s.found;
    FileText *file = cached(p, s.found);
    if (exact)
        array_push(p->arena, &p->searched, (FileSearch){ str_copy(p->arena, name), extensions, (uint32_t)(file - p->file.data) });
    return text_of(p, file, source);
}

/* -- Handles -- */

void file_close(FileHandle *h)
{
    if (h->out)
        fclose(h->out);
    h->out = NULL;
}

static const char *c_text(Parser *p, Str s)
{
    return str_c(&p->temp, s);
}

void file_fopen(Parser *p)
{
    Token name;
    cursor_raw(p, &name);
    if (name.kind != TOK_NAME)
        fail(p->diag, name.loc, "Expected 'undeclared identifier' after #fopen");
    Value *v = symbol_value(name.sym);
    if (v && v->kind != VALUE_NONE && v->kind != VALUE_FILE)
        fail(p->diag, name.loc, "Expected 'undeclared identifier', %s found instead", value_type_name(v));
    Str path = string_expression(p, true);
    int mode = parse_peek(p);
    if (mode != KW_READ && mode != KW_WRITE && mode != KW_APPEND)
        parse_expected(p, "read, write, or append");
    p->have = false;
    FileHandle *h = arena_new(p->arena, FileHandle);
    h->name = str_copy(p->arena, path);
    if (mode == KW_READ) {
        static const char *const none[] = { NULL };
        uint16_t source = 0;
        h->reading = true;
        Str text = file_find(p, path, none, name.loc, true, &source, true);
        lex_start(&h->lexer, source, text);
    } else {
        FileResult result = file_open_write(&p->temp, &p->access, path, mode == KW_APPEND, &h->out);
        if (result != FILE_OK)
            fail_io(p->diag, name.loc, "Cannot open file '%s' for output: %s.", c_text(p, path), file_result_text(result));
        h->next = p->handles;
        p->handles = h;
        p->searched.n = 0;
    }
    if (!v)
        v = symbol_declare(p, name.sym, false, 0)->value;
    if (v->kind == VALUE_FILE)
        file_close(v->file);
    *v = (Value){ .kind = VALUE_FILE, .file = h };
}

void file_fclose(Parser *p)
{
    Token name;
    cursor_raw(p, &name);
    Value *v = name.kind == TOK_NAME ? symbol_value(name.sym) : NULL;
    if (!v || v->kind == VALUE_NONE)
        return;
    if (v->kind != VALUE_FILE)
        fail(p->diag, name.loc, "Expected 'file identifier', %s found instead", value_type_name(v));
    file_close(v->file);
    if (v == &name.sym->binding->own)
        symbol_undef(p, name.sym);
    else
        *v = (Value){ 0 };
}

/* `( H`: the handle and the value that holds it. */
static Value *handle(Parser *p)
{
    parse_expect(p, TOK_LPAREN);
    parse_peek(p);
    if (p->token.kind != TOK_NAME || !p->value || p->value->kind != VALUE_FILE)
        parse_expected(p, "file identifier");
    p->have = false;
    return p->value;
}

/* -- #read -- */

static double signed_number(Parser *p, Lexer *l, Token t)
{
    double sign = 1;
    while (t.kind == TOK_MINUS || t.kind == TOK_PLUS) {
        sign = t.kind == TOK_MINUS ? -sign : sign;
        lex_next(p, l, &t);
    }
    if (t.kind != TOK_NUMBER)
        fail(p->diag, t.loc, "Expected 'float, vector, or string literal' to #read");
    return sign * t.number;
}

/* One literal: a number, <2 to 5 numbers>, or a string. False at the end of the file. */
static bool read_datum(Parser *p, FileHandle *h, Value *out)
{
    Lexer *l = &h->lexer;
    Token t;
    Num n = { { 0 }, 1 };
    lex_next(p, l, &t);
    if (t.kind == TOK_END)
        return false;
    if (t.kind == TOK_STRING) {
        value_set_string(p, out, string_decode(p, (Str){ t.text, t.n }, t.loc, false));
        return true;
    }
    if (t.kind != TOK_LESS) {
        n.v[0] = signed_number(p, l, t);
        value_set_number(p, out, &n);
        return true;
    }
    n.terms = 0;
    lex_next(p, l, &t);
    do {
        if (n.terms == 5)
            fail(p->diag, t.loc, "a vector has at most five components");
        n.v[n.terms++] = signed_number(p, l, t);
        lex_next(p, l, &t);
        if (t.kind == TOK_COMMA)
            lex_next(p, l, &t);
    } while (t.kind != TOK_GREATER);
    if (n.terms < 2)
        fail(p->diag, t.loc, "a vector has at least two components");
    value_set_number(p, out, &n);
    return true;
}

/* At a name. A new one becomes global; an item of an array must hold something already, and keeps its type. */
static void read_target(Parser *p, FileHandle *h)
{
    Token name = p->token;
    Value *v = p->value, datum = { 0 };
    bool is_item = v && v != symbol_value(name.sym);
    p->have = false;
    if (v && v->kind != VALUE_NONE && v->kind != VALUE_NUMBER && v->kind != VALUE_STRING)
        fail(p->diag, name.loc, "#read cannot put a value into the %s '%.*s'", value_type_name(v), STR_ARGS(name.sym->text));
    if (!read_datum(p, h, &datum))
        return;
    if (is_item && !value_same_type(v, &datum))
        fail(p->diag, name.loc, "Attempted to redefine %s as %s.", value_type_name(v), value_type_name(&datum));
    value_move(p, v ? v : symbol_declare(p, name.sym, false, 0)->value, &datum);
}

/* Behind each datum an optional comma is skipped. When instead the file ends there, the handle is closed and its name
 * undefined, so that `#while (defined(H))` ends; a comma with nothing behind it gives one more turn. */
void file_read_directive(Parser *p)
{
    Value *holder = handle(p);
    FileHandle *h = holder->file;
    if (!h->reading)
        fail(p->diag, cursor_loc(p), "Cannot read from file %.*s because the file is open for writing only.", STR_ARGS(h->name));
    bool ended = false;
    parse_accept(p, TOK_COMMA);
    while (!parse_accept(p, TOK_RPAREN)) {
        if (parse_peek(p) != TOK_NAME)
            parse_expected(p, "identifier");
        ended = ended || lex_peek_char(p, &h->lexer) < 0;
        if (ended) {
            p->have = false;                   /* this target keeps what it has */
        } else {
            read_target(p, h);
            ended = !lex_accept(p, &h->lexer, ',') && lex_peek_char(p, &h->lexer) < 0;
        }
        parse_accept(p, TOK_COMMA);
    }
    if (ended)
        *holder = (Value){ 0 };
}

/* -- #write -- */

typedef struct Binary { int keyword, bytes; bool is_signed, big; } Binary;

static const Binary binaries[] = {
    { KW_SINT8, 1, true, false }, { KW_UINT8, 1, false, false }, { KW_SINT16BE, 2, true, true }, { KW_UINT16BE, 2, false, true },
    { KW_SINT16LE, 2, true, false }, { KW_UINT16LE, 2, false, false }, { KW_SINT32BE, 4, true, true },
    { KW_SINT32LE, 4, true, false },
};

/* floor(v + 0.5), within the range of the format. */
static void write_binary(FILE *out, const Binary *b, double v)
{
    double range = ldexp(1, 8 * b->bytes), low = b->is_signed ? -range / 2 : 0, high = low + range - 1;
    v = floor(v + 0.5);
    v = v > low ? v : low;                     /* NaN too */
    int64_t w = (int64_t)(v < high ? v : high);
    for (int i = 0; i < b->bytes; i++)
        fputc((int)(w >> 8 * (b->big ? b->bytes - 1 - i : i) & 255), out);
}

/* What is not ASCII is written as a blank. */
static void write_text(FILE *out, Str s)
{
    unsigned char all = 0;
    for (uint32_t i = 0; i < s.n; i++)
        all |= (unsigned char)s.data[i];
    if (all < 0x80) {
        fwrite_unlocked(s.data, 1, s.n, out);
        return;
    }
    for (uint32_t i = 0; i < s.n; i++)
        if (((unsigned char)s.data[i] & 0xc0) != 0x80)
            fputc(s.data[i] & 0x80 ? ' ' : s.data[i], out);
}

static void write_item(Parser *p, FILE *out)
{
    int kind = parse_peek(p);
    for (size_t i = 0; i < sizeof binaries / sizeof *binaries; i++) {
        if (kind != binaries[i].keyword)
            continue;
        parse_skip(p);
        while (parse_at_number(p)) {
            double v[5];
            int n = parse_terms(p, v);
            for (int k = 0; k < n; k++)
                write_binary(out, &binaries[i], v[k]);
        }
        return;
    }
    if (kind_starts_string(p)) {
        write_text(out, string_expression(p, false));
        return;
    }
    double v[5];
    int n = parse_terms(p, v);
    if (n == 1) {
        fprintf(out, "%g", v[0]);
        return;
    }
    for (int i = 0; i < n; i++)
        fprintf(out, "%s%g", i ? "," : "<", v[i]);
    fputs("> ", out);
}

/* An item of a loop's or macro's that needs no look-ahead; false if it is another. Meshes are written by the hundred thousand. */
static bool write_plain_item(Parser *p, FILE *out)
{
    const Token *t = fast_text_item(p);
    double v[3];
    char text[NUMBER_TEXT];
    if (t != NULL)
        write_text(out, string_decode(p, (Str){ t->text, t->n }, t->loc, false));
    else if (fast_str_item(p, v))
        fwrite_unlocked(text, 1, string_of_number(text, v[0], (int)v[1], (int)v[2]), out);
    else
        return false;
    return true;
}

void file_write_directive(Parser *p)
{
    FileHandle *h = handle(p)->file;
    if (h->reading)
        fail(p->diag, cursor_loc(p), "Cannot write to file %.*s because the file is open for reading only.", STR_ARGS(h->name));
    parse_accept(p, TOK_COMMA);
    for (;;) {
        while (write_plain_item(p, h->out))
            ;
        if (parse_accept(p, TOK_RPAREN))
            break;
        write_item(p, h->out);
        parse_accept(p, TOK_COMMA);
    }
    if (ferror(h->out))
        fail_io(p->diag, cursor_loc(p), "Cannot write to file '%.*s'.", STR_ARGS(h->name));
}
