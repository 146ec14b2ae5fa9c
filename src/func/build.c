/* build.c - from nodes to code: equal nodes are one, constants fold, called functions dissolve into the caller.
 *
 * Nodes are numbered bottom up, so their order is an order of evaluation. func_finish drops what the result does not need, joins
 * products with the sums they go into, and gives registers to values from their birth to their last use. */
#include <math.h>
#include <string.h>

#include "func/native.h"

struct FuncBuilder {
    Arena *arena;
    int parameters;
    ARRAY(Node) node;
    ARRAY(uint32_t) argument;
    uint32_t *slot, mask;                      /* hash table of node numbers + 1 */
};

static bool is_call(unsigned op)
{
    return op >= FUNC_SUM && op <= FUNC_NOISE;
}

FuncBuilder *func_builder(Arena *arena, int parameters)
{
    FuncBuilder *b = arena_new(arena, FuncBuilder);
    b->arena = arena;
    b->parameters = parameters;
    b->mask = 63;
    b->slot = arena_array(arena, uint32_t, b->mask + 1);
    for (int i = 0; i < parameters; i++)
        func_parameter(b, i);
    return b;
}

static bool same_arguments(const FuncBuilder *b, const Node *x, const Node *y)
{
    return x->n == 0 || memcmp(b->argument.data + x->a, b->argument.data + y->a, x->n * sizeof(uint32_t)) == 0;
}

static bool same(const FuncBuilder *b, const Node *x, const Node *y)
{
    if (x->op != y->op || x->part != y->part || x->n != y->n || memcmp(&x->k, &y->k, sizeof x->k) != 0)
        return false;
    return is_call(x->op) ? same_arguments(b, x, y) : x->a == y->a && x->b == y->b && x->c == y->c;
}

static uint32_t hash(const FuncBuilder *b, const Node *x)
{
    uint64_t bits, h = x->op * 0x9e3779b97f4a7c15u + x->part;
    memcpy(&bits, &x->k, sizeof bits);
    h = (h ^ bits) * 0xff51afd7ed558ccdu;
    if (is_call(x->op)) {
        for (unsigned i = 0; i < x->n; i++)
            h = (h ^ b->argument.data[x->a + i]) * 0xff51afd7ed558ccdu;
    } else {
        h = (h ^ x->a) * 0xff51afd7ed558ccdu;
        h = (h ^ x->b) * 0xff51afd7ed558ccdu;
        h = (h ^ x->c) * 0xff51afd7ed558ccdu;
    }
    return (uint32_t)(h ^ h >> 32);
}

static void grow(FuncBuilder *b)
{
    b->mask = b->mask * 2 + 1;
    b->slot = arena_array(b->arena, uint32_t, b->mask + 1);
    for (uint32_t i = 0; i < b->node.n; i++) {
        uint32_t at = hash(b, &b->node.data[i]) & b->mask;
        while (b->slot[at] != 0)
            at = (at + 1) & b->mask;
        b->slot[at] = i + 1;
    }
}

/* The number of this node, an older one if it is known. */
static FuncNode node_of(FuncBuilder *b, Node n)
{
    if (b->node.n * 2 > b->mask)
        grow(b);
    uint32_t at = hash(b, &n) & b->mask;
    for (; b->slot[at] != 0; at = (at + 1) & b->mask)
        if (same(b, &b->node.data[b->slot[at] - 1], &n))
            return b->slot[at] - 1;
    array_push(b->arena, &b->node, n);
    b->slot[at] = b->node.n;
    return b->node.n - 1;
}

FuncNode func_number(FuncBuilder *b, double v)
{
    return node_of(b, (Node){ .op = FUNC_NUMBER, .k = v });
}

FuncNode func_parameter(FuncBuilder *b, int i)
{
    return node_of(b, (Node){ .op = FUNC_PARAMETER, .a = (uint32_t)i });
}

bool func_is_number(const FuncBuilder *b, FuncNode a, double *v)
{
    *v = b->node.data[a].k;
    return b->node.data[a].op == FUNC_NUMBER;
}

FuncNode func_unary(FuncBuilder *b, FuncOp op, FuncNode a)
{
    const Node *n = &b->node.data[a];
    if (n->op == FUNC_NUMBER)
        return func_number(b, code_fold(op, n->k, 0, 0));
    if (op == FUNC_NEG && n->op == FUNC_NEG)
        return n->a;
    if (op == FUNC_ABS && n->op == FUNC_NEG)
        a = n->a;
    return node_of(b, (Node){ .op = (uint16_t)op, .a = a });
}

/* pow(x, 2 ... 8) by squaring. */
static FuncNode small_power(FuncBuilder *b, FuncNode x, int n)
{
    if (n == 1)
        return x;
    FuncNode half = small_power(b, x, n / 2), square = func_binary(b, FUNC_MUL, half, half);
    return n % 2 ? func_binary(b, FUNC_MUL, square, x) : square;
}

/* Results that need no operation; only such as keep the bits of the value, but for the sign of a zero. */
static bool simpler(FuncBuilder *b, FuncOp op, FuncNode x, FuncNode y, FuncNode *out)
{
    double v;
    if (func_is_number(b, y, &v)) {
        if (((op == FUNC_ADD || op == FUNC_SUB) && v == 0) || ((op == FUNC_MUL || op == FUNC_DIV || op == FUNC_POW) && v == 1)) {
            *out = x;
            return true;
        }
        if (op == FUNC_MUL && v == -1) {
            *out = func_unary(b, FUNC_NEG, x);
            return true;
        }
        if (op == FUNC_POW && v >= 2 && v <= 8 && v == floor(v)) {
            *out = small_power(b, x, (int)v);
            return true;
        }
        if (op == FUNC_POW && v == 0) {
            *out = func_number(b, 1);
            return true;
        }
        if (op == FUNC_DIV && v != 0) {        /* POV: division by a number is multiplication by its reciprocal */
            *out = func_binary(b, FUNC_MUL, x, func_number(b, 1 / v));
            return true;
        }
    }
    if (b->node.data[y].op == FUNC_NEG && (op == FUNC_ADD || op == FUNC_SUB)) {
        *out = func_binary(b, op == FUNC_ADD ? FUNC_SUB : FUNC_ADD, x, b->node.data[y].a);
        return true;
    }
    return false;
}

FuncNode func_binary(FuncBuilder *b, FuncOp op, FuncNode x, FuncNode y)
{
    double u, v;
    bool known_u = func_is_number(b, x, &u), known_v = func_is_number(b, y, &v);
    if (known_u && known_v)
        return func_number(b, code_fold(op, u, v, 0));
    bool commutes = op == FUNC_ADD || op == FUNC_MUL;
    if (commutes && (func_is_number(b, x, &u) || (!func_is_number(b, y, &v) && x > y))) {
        FuncNode swap = x;
        x = y;
        y = swap;
    }
    FuncNode known;
    if (simpler(b, op, x, y, &known))
        return known;
    return node_of(b, (Node){ .op = (uint16_t)op, .a = x, .b = y });
}

FuncNode func_choice(FuncBuilder *b, FuncOp op, FuncNode a, FuncNode x, FuncNode y)
{
    double v;
    if (func_is_number(b, a, &v))
        return (op == FUNC_IF_NEGATIVE ? v < 0 : v == 0) ? x : y;
    return x == y ? x : node_of(b, (Node){ .op = (uint16_t)op, .a = a, .b = x, .c = y });
}

static FuncNode call_node(FuncBuilder *b, unsigned op, const void *callee, const FuncNode *arguments, int n, unsigned part)
{
    uint32_t first = b->argument.n;
    for (int i = 0; i < n; i++)
        array_push(b->arena, &b->argument, arguments[i]);
    FuncNode node = node_of(b, (Node){ .op = (uint16_t)op, .part = (uint16_t)part, .n = (uint16_t)n, .a = first, .callee = callee });
    if (b->node.data[node].a != first)
        b->argument.n = first;
    return node;
}

FuncNode build_call(FuncBuilder *b, FuncOp op, const void *callee, const FuncNode *arguments, int n)
{
    return call_node(b, op, callee, arguments, n, 0);
}

/* The callee's nodes again, with the arguments for its parameters. */
static FuncNode dissolve(FuncBuilder *b, const Function *f, const FuncNode *arguments)
{
    FuncNode *to = arena_array(b->arena, FuncNode, f->n_nodes);
    for (uint32_t i = 0; i < f->n_nodes; i++) {
        const Node *n = &f->node[i];
        if (n->op == FUNC_PARAMETER) {
            to[i] = arguments[n->a];
        } else if (n->op == FUNC_NUMBER) {
            to[i] = func_number(b, n->k);
        } else if (is_call(n->op)) {
            FuncNode list[CODE_MAX_ARGUMENTS];
            for (int k = 0; k < n->n; k++)
                list[k] = to[f->node_argument[n->a + (uint32_t)k]];
            to[i] = call_node(b, n->op, n->callee, list, n->n, n->part);
        } else if (n->op >= FUNC_IF_NEGATIVE) {
            to[i] = func_choice(b, (FuncOp)n->op, to[n->a], to[n->b], to[n->c]);
        } else if (n->op >= FUNC_ADD) {
            to[i] = func_binary(b, (FuncOp)n->op, to[n->a], to[n->b]);
        } else {
            to[i] = func_unary(b, (FuncOp)n->op, to[n->a]);
        }
    }
    return to[f->result];
}

FuncNode func_apply(FuncBuilder *b, const Function *f, const FuncNode *arguments, FuncPart part)
{
    if (f->host != NULL)
        return call_node(b, FUNC_HOST, f->host, arguments, f->parameters, part);
    if (b->node.n + f->n_nodes <= CODE_INLINE_LIMIT)
        return dissolve(b, f, arguments);
    return call_node(b, FUNC_CALL, f, arguments, f->parameters, 0);
}

FuncBuilder *func_loop_body(FuncBuilder *outer)
{
    return func_builder(outer->arena, outer->parameters + 1);
}

FuncNode func_loop(FuncBuilder *outer, FuncOp op, FuncNode from, FuncNode to, const Function *body)
{
    FuncNode list[CODE_MAX_ARGUMENTS] = { from, to };
    for (int i = 0; i < outer->parameters; i++)
        list[2 + i] = func_parameter(outer, i);
    return call_node(outer, op, body, list, 2 + outer->parameters, 0);
}

/* What func_finish knows of each node. */
typedef struct Emit {
    const FuncBuilder *b;
    uint32_t *uses, *last;                     /* how often the value is read; by which instruction last */
    uint16_t *reg;
    bool *joined;                              /* a product that its sum computes, or a number that stands in instructions */
    bool *turns;                               /* only sines and cosines of whole multiples are taken: whole turns do not matter */
    bool *squared;                             /* only squares are taken: smooth where a kink is 0 */
    ARRAY(Instr) code;
    ARRAY(uint16_t) argument;
    ARRAY(uint16_t) free;
    uint32_t n_registers;
    bool too_many;
} Emit;

static unsigned operands(const Node *n)
{
    if (n->op == FUNC_NUMBER || n->op == FUNC_PARAMETER || is_call(n->op))
        return 0;
    return n->op >= FUNC_IF_NEGATIVE ? 3 : n->op >= FUNC_ADD ? 2 : 1;
}

static void count_uses(Emit *e, FuncNode result)
{
    const FuncBuilder *b = e->b;
    e->uses[result] = 1;
    for (uint32_t i = b->node.n; i-- > 0;) {
        const Node *n = &b->node.data[i];
        if (e->uses[i] == 0)
            continue;
        const uint32_t operand[3] = { n->a, n->b, n->c };
        for (unsigned k = 0; k < operands(n); k++)
            e->uses[operand[k]]++;
        for (unsigned k = 0; is_call(n->op) && k < n->n; k++)
            e->uses[b->argument.data[n->a + k]]++;
    }
}

static bool is_whole(const FuncBuilder *b, FuncNode x)
{
    double v;
    return func_is_number(b, x, &v) && v == trunc(v);
}

static bool is_any_number(const FuncBuilder *b, FuncNode x)
{
    double v;
    return func_is_number(b, x, &v);
}

static void find_turns(Emit *e, FuncNode result)
{
    const FuncBuilder *b = e->b;
    memset(e->turns, 1, b->node.n);
    e->turns[result] = false;
    for (uint32_t i = b->node.n; i-- > 0;) {
        const Node *n = &b->node.data[i];
        if (e->uses[i] == 0)
            continue;
        bool add = (n->op == FUNC_ADD || n->op == FUNC_SUB) && (is_any_number(b, n->a) || is_any_number(b, n->b));
        bool mul = n->op == FUNC_MUL && (is_whole(b, n->a) || is_whole(b, n->b));
        bool passes = n->op == FUNC_SIN || n->op == FUNC_COS || ((n->op == FUNC_NEG || add || mul) && e->turns[i]);
        const uint32_t operand[3] = { n->a, n->b, n->c };
        for (unsigned k = 0; k < operands(n); k++)
            e->turns[operand[k]] = e->turns[operand[k]] && passes;
        for (unsigned k = 0; is_call(n->op) && k < n->n; k++)
            e->turns[b->argument.data[n->a + k]] = false;
    }
}

static void find_squared(Emit *e, FuncNode result)
{
    const FuncBuilder *b = e->b;
    memset(e->squared, 1, b->node.n);
    e->squared[result] = false;
    for (uint32_t i = 0; i < b->node.n; i++) {
        const Node *n = &b->node.data[i];
        if (e->uses[i] == 0)
            continue;
        const uint32_t operand[3] = { n->a, n->b, n->c };
        for (unsigned k = 0; k < operands(n); k++)
            e->squared[operand[k]] = e->squared[operand[k]] && n->op == FUNC_MUL && n->a == n->b;
        for (unsigned k = 0; is_call(n->op) && k < n->n; k++)
            e->squared[b->argument.data[n->a + k]] = false;
    }
}

/* Is a kink or a jump of node i none to those who read it? */
static bool is_eased(const Emit *e, uint32_t i)
{
    const Node *n = &e->b->node.data[i];
    double v;
    bool from_zero = n->op == FUNC_ABS || ((n->op == FUNC_MIN || n->op == FUNC_MAX) && func_is_number(e->b, n->b, &v) && v == 0);
    return n->op == FUNC_ATAN2 ? e->turns[i] : from_zero && e->squared[i];
}

static bool is_product(const Emit *e, FuncNode x)
{
    const Node *n = &e->b->node.data[x];
    double v;
    return n->op == FUNC_MUL && e->uses[x] == 1 && !func_is_number(e->b, n->b, &v);
}

/* The instruction for a node, its operands still as node numbers in `in`. */
static Instr select_instr(Emit *e, const Node *n, uint32_t in[3])
{
    const FuncBuilder *b = e->b;
    Instr i = { .op = n->op };
    double v;
    in[0] = n->a;
    in[1] = n->b;
    in[2] = n->c;
    bool by_number = operands(n) == 2 && func_is_number(b, n->b, &v);
    if (by_number && (n->op == FUNC_ADD || n->op == FUNC_SUB || n->op == FUNC_MUL)) {
        i.op = n->op == FUNC_MUL ? CODE_MUL_K : CODE_ADD_K;
        i.k = n->op == FUNC_SUB ? -v : v;
        in[1] = UINT32_MAX;
    } else if (operands(n) == 2 && func_is_number(b, n->a, &v) && (n->op == FUNC_SUB || n->op == FUNC_DIV)) {
        i.op = n->op == FUNC_SUB ? CODE_RSUB_K : CODE_RDIV_K;
        i.k = v;
        in[0] = n->b;
        in[1] = UINT32_MAX;
    } else if (n->op == FUNC_MUL && n->a == n->b) {
        i.op = CODE_SQUARE;
        in[1] = UINT32_MAX;
    } else if ((n->op == FUNC_ADD || n->op == FUNC_SUB) && (is_product(e, n->b) || is_product(e, n->a))) {
        bool second = is_product(e, n->b);
        FuncNode product = second ? n->b : n->a;
        i.op = n->op == FUNC_ADD ? CODE_MUL_ADD : second ? CODE_SUB_MUL : CODE_MUL_SUB;
        in[2] = second ? n->a : n->b;
        in[0] = b->node.data[product].a;
        in[1] = b->node.data[product].b;
        e->joined[product] = true;
    }
    return i;
}

static unsigned inputs(unsigned op)
{
    switch (op) {
    case CODE_ADD_K: case CODE_RSUB_K: case CODE_MUL_K: case CODE_RDIV_K: case CODE_SQUARE: return 1;
    case CODE_MUL_ADD: case CODE_MUL_SUB: case CODE_SUB_MUL: return 3;
    default: return op >= FUNC_IF_NEGATIVE ? 3 : op >= FUNC_ADD ? 2 : 1;
    }
}

/* Which nodes get no instruction, and where each value is read last. */
static void plan(Emit *e, FuncNode result)
{
    const FuncBuilder *b = e->b;
    for (uint32_t i = b->node.n; i-- > 0;) {
        const Node *n = &b->node.data[i];
        if (e->uses[i] == 0 || e->joined[i] || n->op == FUNC_PARAMETER)
            continue;
        uint32_t in[3];
        if (is_call(n->op)) {
            for (unsigned k = 0; k < n->n; k++)
                if (e->last[b->argument.data[n->a + k]] == 0)
                    e->last[b->argument.data[n->a + k]] = i;
        } else if (n->op != FUNC_NUMBER) {
            Instr instr = select_instr(e, n, in);
            for (unsigned k = 0; k < inputs(instr.op); k++)
                if (e->last[in[k]] == 0)
                    e->last[in[k]] = i;
        }
    }
    e->last[result] = UINT32_MAX;
}

static uint16_t take_register(Emit *e)
{
    if (e->free.n > 0)
        return e->free.data[--e->free.n];
    if (e->n_registers >= CODE_MAX_REGISTERS) {
        e->too_many = true;
        return 0;
    }
    return (uint16_t)(e->n_registers++ * CODE_ROW);
}

static void release(Emit *e, const FuncBuilder *b, uint32_t x, uint32_t now)
{
    if (e->last[x] == now) {
        array_push(b->arena, &e->free, e->reg[x]);
        e->last[x] = UINT32_MAX;               /* once */
    }
}

static void emit_node(Emit *e, uint32_t at)
{
    const FuncBuilder *b = e->b;
    const Node *n = &b->node.data[at];
    Instr i;
    if (n->op == FUNC_NOISE) {
        const uint32_t *in = b->argument.data + n->a;
        i = (Instr){ .op = FUNC_NOISE, .a = e->reg[in[0]], .b = e->reg[in[1]], .c = e->reg[in[2]], .callee = n->callee };
        for (unsigned k = 0; k < 3; k++)
            release(e, b, in[k], at);
    } else if (is_call(n->op)) {
        i = (Instr){ .op = n->op, .a = (uint16_t)e->argument.n, .c = n->part, .n = n->n, .callee = n->callee };
        for (unsigned k = 0; k < n->n; k++)
            array_push(b->arena, &e->argument, e->reg[b->argument.data[n->a + k]]);
        i.b = 1;
        for (unsigned k = 1; k < n->n; k++)
            i.b = i.b != 0 && e->argument.data[i.a + k] == e->argument.data[i.a] + k * CODE_ROW;
        for (unsigned k = 0; k < n->n; k++)
            release(e, b, b->argument.data[n->a + k], at);
        e->too_many = e->too_many || e->argument.n > UINT16_MAX;
    } else if (n->op == FUNC_NUMBER) {
        i = (Instr){ .op = FUNC_NUMBER, .k = n->k };
    } else {
        uint32_t in[3];
        i = select_instr(e, n, in);
        uint16_t *to[3] = { &i.a, &i.b, &i.c };
        for (unsigned k = 0; k < inputs(i.op); k++)
            *to[k] = e->reg[in[k]];
        for (unsigned k = 0; k < inputs(i.op); k++)
            release(e, b, in[k], at);
        i.n = is_eased(e, at);
    }
    i.dst = e->reg[at] = take_register(e);
    array_push(b->arena, &e->code, i);
}

static int depth_of(const Emit *e)
{
    int depth = 0;
    for (uint32_t i = 0; i < e->code.n; i++) {
        const Instr *instr = &e->code.data[i];
        if (instr->op == FUNC_CALL || instr->op == FUNC_SUM || instr->op == FUNC_PROD) {
            int below = ((const Function *)instr->callee)->depth + 1;
            depth = below > depth ? below : depth;
        }
    }
    return depth;
}

const Function *func_finish(FuncBuilder *b, FuncNode result)
{
    uint32_t n = b->node.n;
    Emit e = { .b = b, .n_registers = (uint32_t)b->parameters };
    e.uses = arena_array(b->arena, uint32_t, n);
    e.last = arena_array(b->arena, uint32_t, n);
    e.reg = arena_array(b->arena, uint16_t, n);
    e.joined = arena_array(b->arena, bool, n);
    e.turns = arena_array(b->arena, bool, n);
    e.squared = arena_array(b->arena, bool, n);
    count_uses(&e, result);
    find_turns(&e, result);
    find_squared(&e, result);
    plan(&e, result);
    for (uint32_t i = 0; i < n; i++) {
        const Node *node = &b->node.data[i];
        if (node->op == FUNC_PARAMETER) {
            e.reg[i] = (uint16_t)(node->a * CODE_ROW);
            e.last[i] = UINT32_MAX;            /* registers of parameters are not given away */
        } else if (e.uses[i] > 0 && !e.joined[i] && e.last[i] != 0) {
            emit_node(&e, i);
        }
    }
    array_push(b->arena, &e.code, (Instr){ .op = CODE_END, .a = e.reg[result] });
    int depth = depth_of(&e);
    if (e.too_many || depth > CODE_MAX_DEPTH)
        return NULL;
    Function *f = arena_new(b->arena, Function);
    *f = (Function){ .parameters = b->parameters, .terms = 1, .code = e.code.data, .argument = e.argument.data,
                     .n_registers = e.n_registers > 0 ? e.n_registers : 1, .depth = depth, .node = b->node.data,
                     .node_argument = b->argument.data, .n_nodes = n, .result = result };
    return f;
}

const Function *func_of_host(Arena *arena, const FuncHost *host)
{
    Function *f = arena_new(arena, Function);
    *f = (Function){ .parameters = host->parameters, .terms = host->terms, .host = arena_copy(arena, host, sizeof *host) };
    return f;
}
