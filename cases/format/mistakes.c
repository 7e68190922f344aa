#include "cases/format/mistakes.h"

#include <jansson.h>
#include <stdarg.h>
#include <string.h>

/* Is the place before that of the mistake? */
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
        return fault_set(f, STATUS_FAULT, "%.100s: out of memory", m->file);
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
        fprintf(to, "%s: and %d more; correct these first\n", m->file, m->more);
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
        return fault_set(f, STATUS_FAULT, "the list of mistakes cannot be written");
    fputc('\n', to);
    return STATUS_OK;
}
