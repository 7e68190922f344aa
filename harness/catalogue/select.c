/* expression := term { or term };  term := factor { [and] factor };  factor := not factor | word */
#include "harness/catalogue/select.h"

#include <string.h>

typedef struct scanner {
    const char *at;
    const char *text;
    int bad;
} scanner;

static size_t word_length(const char *at)
{
    return strcspn(at, " \t");
}

static int next_is(scanner *s, const char *word)
{
    s->at += strspn(s->at, " \t");
    return word_length(s->at) == strlen(word) && strncmp(s->at, word, strlen(word)) == 0;
}

static int factor_holds(scanner *s)
{
    if (next_is(s, "not")) {
        s->at += 3;
        return !factor_holds(s);
    }
    char word[128];
    const size_t length = word_length(s->at);
    if (length == 0 || length >= sizeof word || next_is(s, "and") || next_is(s, "or")) {
        s->bad = 1;
        return 0;
    }
    memcpy(word, s->at, length);
    word[length] = '\0';
    s->at += length;
    return strstr(s->text, word) != NULL;
}

static int term_holds(scanner *s)
{
    int holds = factor_holds(s);
    while (!s->bad) {
        if (next_is(s, "and"))
            s->at += 3;
        else if (*s->at == '\0' || next_is(s, "or"))
            break;
        const int next = factor_holds(s);
        holds = holds && next;
    }
    return holds;
}

int select_matches(const char *expression, const char *text)
{
    scanner s = {expression, text, 0};
    int holds = term_holds(&s);
    while (!s.bad && next_is(&s, "or")) {
        s.at += 2;
        const int next = term_holds(&s);
        holds = holds || next;
    }
    return s.bad || *s.at != '\0' ? -1 : holds;
}
