#include "cases/format/format_impl.h"

#include <jansson.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <yaml.h>

typedef struct document_reader {
    yaml_parser_t parser;
    arena *arena;
    mistakes *mistakes;
    int nodes;
} document_reader;

enum { MOST_NODES = 100000, MOST_TEXT = 4000 };

static document_node *read_node(document_reader *r, const yaml_event_t *event, int depth);

static void *refuse(document_reader *r, yaml_mark_t at, const char *what)
{
    mistakes_add(r->mistakes, (int)at.line + 1, (int)at.column + 1, "%s", what);
    return NULL;
}

/* Reports a syntax error. */
static void report_syntax(document_reader *r)
{
    const yaml_parser_t *p = &r->parser;
    const char *context = p->context != NULL ? p->context : "";
    const char *problem = p->problem != NULL ? p->problem : "this text cannot be read";
    const int line = (int)p->problem_mark.line + 1, column = (int)p->problem_mark.column + 1;
    const int in_flow = strstr(context, "flow") != NULL;
    if (p->error == YAML_MEMORY_ERROR)
        r->mistakes->out_of_memory = 1;
    else if (p->error == YAML_READER_ERROR)
        mistakes_add(
            r->mistakes, line, column,
            "byte %zu is not valid text (%s); save the file as UTF-8, without control characters",
            p->problem_offset, problem);
    else if (strstr(problem, "cannot start any token") != NULL &&
             p->buffer.pointer < p->buffer.last && *p->buffer.pointer == '\t')
        mistakes_add(r->mistakes, line, column, "the line is indented with a tab; use spaces");
    else if (in_flow)
        mistakes_add(
            r->mistakes, line, column,
            "the %s opened in line %d, column %d is not closed here (%s); close it, or add a comma",
            strstr(context, "mapping") != NULL ? "'{'" : "'['", (int)p->context_mark.line + 1,
            (int)p->context_mark.column + 1, problem);
    else
        mistakes_add(r->mistakes, line, column,
                     "invalid YAML (%s%s%s); correct indentation, colons and quotes", context,
                     context[0] != '\0' ? ": " : "", problem);
}

/* Reads the next event, which the caller must delete. Returns 1, or 0 after a syntax error. */
static int next(document_reader *r, yaml_event_t *event)
{
    if (yaml_parser_parse(&r->parser, event))
        return 1;
    report_syntax(r);
    return 0;
}

static document_node *new_node(document_reader *r, document_kind kind, yaml_mark_t at)
{
    if (r->nodes++ >= MOST_NODES)
        return refuse(r, at, "the file has more than 100000 entries; write a smaller file");
    document_node *n = arena_take(r->arena, sizeof *n);
    if (n == NULL) {
        r->mistakes->out_of_memory = 1;
        return NULL;
    }
    n->kind = kind;
    n->line = (int)at.line + 1;
    n->column = (int)at.column + 1;
    return n;
}

/* Returns the number of characters in UTF-8 text. */
static int characters(const char *text, int bytes)
{
    int count = 0;
    for (int i = 0; i < bytes && text[i] != '\0'; i++)
        count += ((unsigned char)text[i] & 0xc0) != 0x80;
    return count;
}

static document_node *read_text(document_reader *r, const yaml_event_t *event)
{
    const char *value = (const char *)event->data.scalar.value;
    size_t length = event->data.scalar.length;
    const yaml_mark_t from = event->start_mark, to = event->end_mark;
    const int quoted = event->data.scalar.style != YAML_PLAIN_SCALAR_STYLE;
    while (length > 0 && value[length - 1] == '\n')
        length--;
    if (length > MOST_TEXT)
        return refuse(r, from, "the text has more than 4000 characters; shorten it");
    for (size_t i = 0; i < length; i++)
        if ((unsigned char)value[i] < ' ' || value[i] == 0x7f)
            return refuse(
                r, from,
                "the text contains a control character; write it in one line, without tabs");
    document_node *n = new_node(r, DOCUMENT_TEXT, from);
    if (n == NULL)
        return NULL;
    n->text = arena_copy(r->arena, value, length);
    if (n->text == NULL) {
        r->mistakes->out_of_memory = 1;
        return NULL;
    }
    const int columns = (int)(to.column - from.column), one_line = from.line == to.line;
    n->inset = one_line && columns == characters(n->text, (int)length) + 2 * quoted ? quoted : -1;
    return n;
}

static int add_entry(document_reader *r, document_node *n, document_node *key, document_node *item)
{
    n->item = arena_grow(r->arena, n->item, n->count, sizeof(document_node *));
    if (key != NULL)
        n->key = arena_grow(r->arena, n->key, n->count, sizeof(document_node *));
    if (n->item == NULL || (key != NULL && n->key == NULL)) {
        r->mistakes->out_of_memory = 1;
        return 0;
    }
    n->item[n->count] = item;
    if (key != NULL)
        n->key[n->count] = key;
    n->count++;
    return 1;
}

/* Returns 1 if the key is valid. Otherwise reports an error and returns 0. */
static int check_key(document_reader *r, const document_node *map, const document_node *key)
{
    if (key->kind != DOCUMENT_TEXT) {
        document_mistake(r->mistakes, key, 0, "a key must be a name, not a list or map");
        return 0;
    }
    if (strcmp(key->text, "<<") == 0) {
        document_mistake(
            r->mistakes, key, 0,
            "merge keys are not supported; write the entries, or use 'for', 'let' or 'parts'");
        return 0;
    }
    for (int i = 0; i < map->count; i++)
        if (strcmp(map->key[i]->text, key->text) == 0) {
            document_mistake(r->mistakes, key, 0,
                             "the key '%.60s' is also in line %d; rename or remove one of them",
                             key->text, map->key[i]->line);
            return 0;
        }
    return 1;
}

static int read_entries(document_reader *r, document_node *n, int depth, yaml_event_type_t end)
{
    yaml_event_t event;
    while (next(r, &event)) {
        if (event.type == end) {
            yaml_event_delete(&event);
            return 1;
        }
        document_node *key = NULL, *item = read_node(r, &event, depth + 1);
        yaml_event_delete(&event);
        if (item == NULL)
            return 0;
        if (n->kind == DOCUMENT_MAP) {
            key = item;
            if (!next(r, &event))
                return 0;
            item = read_node(r, &event, depth + 1);
            yaml_event_delete(&event);
            if (item == NULL)
                return 0;
            if (!check_key(r, n, key))
                continue;
        }
        if (n->count == DOCUMENT_ENTRIES) {
            document_mistake(r->mistakes, item, 0,
                             "the list or map has more than 10000 entries; write a smaller one");
            return 0;
        }
        if (!add_entry(r, n, key, item))
            return 0;
    }
    return 0;
}

static document_node *read_collection(document_reader *r, const yaml_event_t *event, int depth)
{
    const int map = event->type == YAML_MAPPING_START_EVENT;
    if (depth == DOCUMENT_DEPTH)
        return refuse(r, event->start_mark,
                      "lists and maps are nested more than 16 levels deep; simplify the file");
    document_node *n = new_node(r, map ? DOCUMENT_MAP : DOCUMENT_LIST, event->start_mark);
    const yaml_event_type_t end = map ? YAML_MAPPING_END_EVENT : YAML_SEQUENCE_END_EVENT;
    return n != NULL && read_entries(r, n, depth, end) ? n : NULL;
}

static document_node *read_node(document_reader *r, const yaml_event_t *event, int depth)
{
    static const char anchor[] = "anchors are not supported; write the entry at each place where "
                                 "it is needed, or use 'for', 'let' or 'parts'";
    static const char tag[] = "tags are not supported; remove it, because the key determines "
                              "whether a value is a string, a number or a word";
    switch (event->type) {
    case YAML_ALIAS_EVENT:
        return refuse(
            r, event->start_mark,
            "aliases are not supported; repeat the entry, or use 'for', 'let' or 'parts'");
    case YAML_SCALAR_EVENT:
        if (event->data.scalar.anchor != NULL)
            return refuse(r, event->start_mark, anchor);
        return event->data.scalar.tag != NULL ? refuse(r, event->start_mark, tag)
                                              : read_text(r, event);
    case YAML_SEQUENCE_START_EVENT:
        if (event->data.sequence_start.anchor != NULL)
            return refuse(r, event->start_mark, anchor);
        return event->data.sequence_start.tag != NULL ? refuse(r, event->start_mark, tag)
                                                      : read_collection(r, event, depth);
    case YAML_MAPPING_START_EVENT:
        if (event->data.mapping_start.anchor != NULL)
            return refuse(r, event->start_mark, anchor);
        return event->data.mapping_start.tag != NULL ? refuse(r, event->start_mark, tag)
                                                     : read_collection(r, event, depth);
    default:
        return refuse(r, event->start_mark, "the file is empty; begin with 'beamwork: 1'");
    }
}

static document_node *read_stream(document_reader *r)
{
    yaml_event_t event;
    document_node *root = NULL;
    for (int done = 0; !done && next(r, &event);) {
        const yaml_mark_t at = event.start_mark;
        switch (event.type) {
        case YAML_STREAM_START_EVENT:
        case YAML_DOCUMENT_END_EVENT:
            break;
        case YAML_DOCUMENT_START_EVENT:
            if (root != NULL)
                refuse(r, at, "the file contains a second YAML document; move it to another file");
            if (event.data.document_start.version_directive != NULL ||
                event.data.document_start.tag_directives.start !=
                    event.data.document_start.tag_directives.end)
                refuse(r, at,
                       "YAML directives are not supported; remove lines that begin with '%'");
            done = root != NULL;
            break;
        case YAML_STREAM_END_EVENT:
            if (root == NULL)
                refuse(r, at, "the file is empty; begin with 'beamwork: 1'");
            done = 1;
            break;
        default:
            root = read_node(r, &event, 0);
            done = root == NULL;
            break;
        }
        yaml_event_delete(&event);
    }
    return root;
}

document_node *document_read(const char *bytes, size_t size, arena *a, mistakes *m)
{
    document_reader r = {.arena = a, .mistakes = m};
    if (size > DOCUMENT_BYTES) {
        mistakes_add(m, 1, 1, "the file is larger than 1 MB; write a smaller file");
        return NULL;
    }
    if (!yaml_parser_initialize(&r.parser)) {
        m->out_of_memory = 1;
        return NULL;
    }
    yaml_parser_set_encoding(&r.parser, YAML_UTF8_ENCODING);
    const size_t mark = size >= 3 && memcmp(bytes, "\xef\xbb\xbf", 3) == 0 ? 3 : 0;
    yaml_parser_set_input_string(&r.parser, (const unsigned char *)bytes + mark, size - mark);
    document_node *root = read_stream(&r);
    yaml_parser_delete(&r.parser);
    return m->count == 0 && !m->out_of_memory ? root : NULL;
}

const document_node *document_find(const document_node *map, const char *key)
{
    if (map == NULL || map->kind != DOCUMENT_MAP)
        return NULL;
    for (int i = 0; i < map->count; i++)
        if (strcmp(map->key[i]->text, key) == 0)
            return map->item[i];
    return NULL;
}

void document_mistake(mistakes *m, const document_node *n, int offset, const char *format, ...)
{
    char text[FAULT_TEXT];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    const int inside = n->kind == DOCUMENT_TEXT && n->inset >= 0;
    mistakes_add(m, n->line, n->column + (inside ? n->inset + characters(n->text, offset) : 0),
                 "%s", text);
}

enum { BLOCK = 1 << 10, ALIGNMENT = 16 };
/* Maximum number of bytes of an arena, sufficient for the largest allowed file. */
static const size_t most = (size_t)1 << 28;

typedef struct arena_block {
    struct arena_block *next;
    size_t size;
    _Alignas(ALIGNMENT) char bytes[];
} arena_block;

static void *add_block(arena *a, size_t size)
{
    const size_t room = size > BLOCK ? size : BLOCK;
    arena_block *b = a->total + room > most ? NULL : calloc(1, sizeof *b + room);
    if (b == NULL) {
        a->failed = 1;
        return NULL;
    }
    b->next = a->block;
    b->size = room;
    a->block = b;
    a->used = size;
    a->total += room;
    return b->bytes;
}

void *arena_take(arena *a, size_t size)
{
    const size_t rounded = (size + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
    if (a->block == NULL || a->used + rounded > a->block->size)
        return add_block(a, rounded);
    void *taken = a->block->bytes + a->used;
    a->used += rounded;
    return taken;
}

const char *arena_copy(arena *a, const char *text, size_t length)
{
    char *copy = arena_take(a, length + 1);
    if (copy != NULL)
        memcpy(copy, text, length);
    return copy;
}

void *arena_grow(arena *a, void *list, int count, size_t size)
{
    if ((count & (count - 1)) != 0)
        return list;
    void *larger = arena_take(a, (count == 0 ? 1 : 2 * (size_t)count) * size);
    if (larger != NULL && count > 0)
        memcpy(larger, list, (size_t)count * size);
    return larger;
}

void arena_free(arena *a)
{
    while (a->block != NULL) {
        arena_block *next = a->block->next;
        free(a->block);
        a->block = next;
    }
    memset(a, 0, sizeof *a);
}

static int is_before(int line, int column, const mistake *other)
{
    return line < other->line || (line == other->line && column < other->column);
}

void mistakes_add(mistakes *m, int line, int column, const char *format, ...)
{
    int at = 0;
    while (at < m->count && !is_before(line, column, &m->list[at]))
        at++;
    if (at > 0 && m->list[at - 1].line == line && m->list[at - 1].column == column)
        return;
    if (m->count == MISTAKES_MOST)
        m->more++;
    if (at == MISTAKES_MOST)
        return;
    const int kept = m->count < MISTAKES_MOST ? m->count : MISTAKES_MOST - 1;
    memmove(&m->list[at + 1], &m->list[at], (size_t)(kept - at) * sizeof *m->list);
    m->count = kept + 1;
    m->list[at].line = line;
    m->list[at].column = column;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(m->list[at].text, sizeof m->list[at].text, format, arguments);
    va_end(arguments);
}

const char *mistakes_remedy(const char *near, const char *remedy, char text[FAULT_TEXT])
{
    if (near != NULL)
        snprintf(text, FAULT_TEXT, "; did you mean '%.60s'?", near);
    else
        snprintf(text, FAULT_TEXT, "%s", remedy);
    return text;
}

status mistakes_status(const mistakes *m, fault *f)
{
    if (m->out_of_memory)
        return fault_memory(f, "%.100s", m->file);
    if (m->count == 0)
        return STATUS_OK;
    return fault_set(f, STATUS_REFUSED, "%.100s:%d:%d: %.200s", m->file, m->list[0].line,
                     m->list[0].column, m->list[0].text);
}

void mistakes_print(const mistakes *m, FILE *to)
{
    for (int i = 0; i < m->count; i++)
        fprintf(to, "%s:%d:%d: %s\n", m->file, m->list[i].line, m->list[i].column, m->list[i].text);
    if (m->more > 0)
        fprintf(to, "%s: number of further errors: %d; correct those above first\n", m->file,
                m->more);
    if (m->out_of_memory)
        fprintf(to, "%s: out of memory\n", m->file);
}

static json_t *list_of(const mistakes *m)
{
    json_t *list = json_array();
    for (int i = 0; i < m->count; i++) {
        const mistake *one = &m->list[i];
        json_t *entry = json_pack("{s:i, s:i, s:s}", "line", one->line, "column", one->column,
                                  "text", one->text);
        if (json_array_append_new(list, entry) != 0) {
            json_decref(list);
            return NULL;
        }
    }
    return list;
}

status mistakes_json(const mistakes *m, FILE *to, fault *f)
{
    json_t *all =
        json_pack("{s:s, s:o, s:i}", "file", m->file, "mistakes", list_of(m), "more", m->more);
    const int written = all != NULL && json_dumpf(all, to, JSON_INDENT(1)) == 0;
    json_decref(all);
    if (!written)
        return fault_set(f, STATUS_FAULT,
                         "the list of errors cannot be written; free memory or disk space");
    fputc('\n', to);
    return STATUS_OK;
}
