#include "harness/formulations/channel.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>

#include "harness/formulations/words.h"

static const char mark[8] = {'b', 'e', 'a', 'm', 'w', 'o', 'r', 'k'};
enum { MESSAGE = 300 };

status channel_init(channel *c, const char *command, fault *f)
{
    const size_t room = strlen(command) + 80;
    *c = (channel){.who = malloc(room), .limit = 120};
    if (c->who == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for a formulation");
    snprintf(c->who, room, "exec:%s", command);
    pthread_mutex_init(&c->lock, NULL);
    return words_split(command, &c->words, f);
}

status channel_call(channel *c, const char *name, fault *f)
{
    const size_t room = strlen(name) + 20;
    char *who = malloc(room);
    if (who == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for a formulation");
    snprintf(who, room, "formulation %s", name);
    free(c->who);
    c->who = who;
    return STATUS_OK;
}

void channel_end(channel *c)
{
    child_end(&c->process, 1);
    free(c->who);
    free(c->words);
    free(c->in.at);
    free(c->out.at);
    *c = (channel){.who = NULL};
}

void channel_note(channel *c, status outcome, const fault *why)
{
    if (outcome < STATUS_REFUSED || (c->trouble[0] != '\0' && !c->told))
        return;
    memcpy(c->trouble, why->text, sizeof c->trouble);
    c->told = 0;
}

/* On one line: what is no character to print becomes a dot. */
static void on_one_line(char text[])
{
    for (; *text != '\0'; text++)
        if ((unsigned char)*text < ' ' || *text == 127)
            *text = '.';
}

static void how_it_ended(int how, char words[], size_t size)
{
    if (how == -1)
        snprintf(words, size, "closed its standard output");
    else if (WIFSIGNALED(how))
        snprintf(words, size, "ended by signal %d (%s)", WTERMSIG(how), strsignal(WTERMSIG(how)));
    else
        snprintf(words, size, "ended with status %d", WEXITSTATUS(how));
}

status channel_break(channel *c, const char *why, fault *f)
{
    child_end(&c->process, 1);
    snprintf(c->trouble, sizeof c->trouble, "%.100s: %.200s", c->who, why);
    on_one_line(c->trouble);
    c->told = 0;
    return fault_set(f, STATUS_FAULT, "%s", c->trouble);
}

/* What the process has done instead of answering. */
static status breach(channel *c, child_event what, const char *when, fault *f)
{
    char why[200], how[100];
    if (what == CHILD_LATE) {
        snprintf(why, sizeof why, "its process did not answer within %d s%s", c->limit, when);
    } else if (what == CHILD_SPOKE) {
        snprintf(why, sizeof why,
                 "its process wrote more than an answer to standard output%s; print to standard "
                 "error",
                 when);
    } else {
        how_it_ended(child_end(&c->process, 0), how, sizeof how);
        snprintf(why, sizeof why, "its process %s%s", how, when);
    }
    return channel_break(c, why, f);
}

/* Reads a line; where it is JSON, nothing may stand behind it. */
static status first_line(channel *c, char line[], fault *f)
{
    size_t count = 0;
    while (memchr(line, '\n', count) == NULL) {
        size_t more = 0;
        const child_event what = child_read(&c->process, line + count, 1,
                                            (size_t)HANDSHAKE_MOST - count, &more, c->limit);
        count += more;
        if (what != CHILD_DONE)
            return breach(c, what, " before its first line", f);
        if (count == HANDSHAKE_MOST && memchr(line, '\n', count) == NULL)
            return channel_break(c, "its process began with no line of JSON", f);
    }
    char *end = memchr(line, '\n', count);
    if (end != line + count - 1 && line[0] == '{')
        return breach(c, CHILD_SPOKE, " behind its first line", f);
    *end = '\0';
    on_one_line(line);
    return STATUS_OK;
}

status channel_start(channel *c, char line[], fault *f)
{
    child_end(&c->process, 1);
    c->trouble[0] = '\0';
    c->started++;
    TRY(child_start(c->words, &c->process, f));
    return first_line(c, line, f) == STATUS_OK ? STATUS_OK : STATUS_REFUSED;
}

int channel_runs(const channel *c)
{
    return child_runs(&c->process);
}

/* At least `count` bytes in all; 0: memory. */
static int make_room(channel_bytes *b, size_t count)
{
    if (count <= b->room)
        return 1;
    char *more = realloc(b->at, count + b->room);
    if (more == NULL)
        return 0;
    b->at = more;
    b->room += count;
    return 1;
}

void channel_begin(channel *c)
{
    c->out.count = CHANNEL_HEADER;
}

void *channel_add(channel *c, size_t count)
{
    if (!make_room(&c->out, c->out.count + count))
        return NULL;
    void *to = c->out.at + c->out.count;
    c->out.count += count;
    return to;
}

static status no_memory(fault *f)
{
    return fault_set(f, STATUS_FAULT, "out of memory for a mesh in a request");
}

/* The line that comes with another outcome. */
static status refused(channel *c, status outcome, size_t bytes, size_t had, fault *f)
{
    char text[MESSAGE + 1] = "", *rest = c->in.at + CHANNEL_ANSWER;
    size_t more = 0;
    const size_t here = had - CHANNEL_ANSWER;
    if (bytes > MESSAGE || here > bytes)
        return channel_break(c, "the line of its refusal is longer than 300 bytes", f);
    memcpy(text, rest, here);
    if (here < bytes) {
        const child_event what =
            child_read(&c->process, text + here, bytes - here, bytes - here, &more, c->limit);
        if (what != CHILD_DONE)
            return breach(c, what, " in the middle of an answer", f);
    }
    on_one_line(text);
    return fault_set(f, outcome, "%.100s: %.200s", c->who, text[0] != '\0' ? text : "refused");
}

/* The rest of an answer whose header and a bit more is there. */
static status rest_of(channel *c, size_t least, size_t most, size_t had, size_t *count, fault *f)
{
    int64_t head[2];
    char why[200];
    size_t more = 0;
    memcpy(head, c->in.at + sizeof mark, sizeof head);
    if (memcmp(c->in.at, mark, sizeof mark) != 0) {
        snprintf(why, sizeof why,
                 "its process wrote '%.*s' where an answer was due; print to standard error",
                 (int)(had < 40 ? had : 40), c->in.at);
        return channel_break(c, why, f);
    }
    if (head[0] < STATUS_OK || head[0] > STATUS_REFUSED || head[1] < 0)
        return channel_break(c, "an answer has an outcome that is none of 0 to 3", f);
    if (head[0] != STATUS_OK)
        return refused(c, (status)head[0], (size_t)head[1], had, f);
    *count = (size_t)head[1];
    if (*count != least && *count != most) {
        snprintf(why, sizeof why, "an answer has %zu bytes where %zu were asked for", *count, most);
        return channel_break(c, why, f);
    }
    if (had > CHANNEL_ANSWER + *count)
        return breach(c, CHILD_SPOKE, "", f);
    const size_t left = CHANNEL_ANSWER + *count - had;
    const child_event what = child_read(&c->process, c->in.at + had, left, left, &more, c->limit);
    return what == CHILD_DONE ? STATUS_OK : breach(c, what, " in the middle of an answer", f);
}

status channel_ask(channel *c, enum channel_request what, int mask, int elements, size_t least,
                   size_t most, const char **body, size_t *count, fault *f)
{
    const int64_t head[4] = {what, mask, elements, (int64_t)(c->out.count - CHANNEL_HEADER)};
    size_t had = 0;
    if (!make_room(&c->in, CHANNEL_ANSWER + most + 1) || !make_room(&c->out, c->out.count))
        return no_memory(f);
    memcpy(c->out.at, mark, sizeof mark);
    memcpy(c->out.at + sizeof mark, head, sizeof head);
    child_event event = child_write(&c->process, c->out.at, c->out.count, c->limit);
    if (event == CHILD_DONE)
        event = child_read(&c->process, c->in.at, CHANNEL_ANSWER, CHANNEL_ANSWER + most + 1, &had,
                           c->limit);
    if (event == CHILD_ENDED && had > 0 && had < CHANNEL_ANSWER)
        return breach(c, event, " in the middle of an answer", f);
    if (event != CHILD_DONE)
        return breach(c, event, event == CHILD_ENDED ? " and gave no answer" : "", f);
    TRY(rest_of(c, least, most, had, count, f));
    *body = c->in.at + CHANNEL_ANSWER;
    return STATUS_OK;
}
