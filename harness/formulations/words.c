#include "harness/formulations/words.h"

#include <stdlib.h>
#include <string.h>

/* Copies one word without its quotes; returns what follows it, NULL: a quote does not end. */
static const char *take(const char *from, char **to)
{
    char quote = '\0';
    for (; *from != '\0' && (quote != '\0' || strchr(" \t\n", *from) == NULL); from++)
        if (quote != '\0' && *from == quote)
            quote = '\0';
        else if (quote == '\0' && (*from == '\'' || *from == '"'))
            quote = *from;
        else
            *(*to)++ = *from;
    *(*to)++ = '\0';
    return quote == '\0' ? from : NULL;
}

status words_split(const char *command, char ***words, fault *f)
{
    const size_t list = (WORDS_MOST + 1) * sizeof(char *);
    char **out = malloc(list + strlen(command) + WORDS_MOST + 1);
    int count = 0;
    if (out == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for a command");
    char *to = (char *)out + list;
    const char *from = command + strspn(command, " \t\n"), *why = NULL;
    while (from != NULL && *from != '\0' && count < WORDS_MOST) {
        out[count++] = to;
        from = take(from, &to);
        if (from != NULL)
            from += strspn(from, " \t\n");
    }
    out[count] = NULL;
    if (from == NULL)
        why = "a quote does not end";
    else if (*from != '\0')
        why = "too many words; put them into a script";
    else if (count == 0 || out[0][0] == '\0')
        why = "there is no command; give one such as 'exec:python3 my_beam.py'";
    if (why == NULL) {
        *words = out;
        return STATUS_OK;
    }
    free(out);
    return fault_set(f, STATUS_REFUSED, "exec:%.100s: %s", command, why);
}

void words_quote(FILE *to, const char *word)
{
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                                "_-+=:,./@%";
    if (word[0] != '\0' && word[strspn(word, plain)] == '\0') {
        fputs(word, to);
        return;
    }
    fputc('\'', to);
    for (; *word != '\0'; word++)
        if (*word == '\'')
            fputs("'\\''", to);
        else
            fputc(*word, to);
    fputc('\'', to);
}

void words_quoted(const char *word, char *out, size_t size)
{
    FILE *to = fmemopen(out, size, "w");
    out[0] = '\0';
    if (to == NULL)
        return;
    words_quote(to, word);
    fclose(to);
    out[size - 1] = '\0';
}
