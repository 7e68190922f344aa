#include "harness/library/contestants.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "harness/study/study.h"

status contestants_parse(const char *names, formulation list[CONTESTANTS_MOST], int *count,
                         int *named, fault *f)
{
    int all = 0;
    char one[FORMULATION_KEY + 64];
    *count = 0;
    for (const char *at = names != NULL ? names : ""; *at != '\0';) {
        const int blanks = (int)strspn(at, " "), length = (int)strcspn(at + blanks, " ");
        at += blanks;
        if (length >= (int)sizeof one)
            return fault_set(f, STATUS_REFUSED, "formulation '%.60s...': the name is too long", at);
        snprintf(one, sizeof one, "%.*s", length, at);
        if (length > 0)
            TRY(formulation_list_add(one, CONTESTANTS_MOST, list, count, f));
        all |= strcmp(one, "all") == 0;
        at += length;
    }
    if (named != NULL)
        *named = *count > 0 && !all;
    return STATUS_OK;
}

int contestants_jobs(void)
{
    const long processors = sysconf(_SC_NPROCESSORS_ONLN);
    return processors < 1 ? 1 : processors < WORKERS_MOST ? (int)processors : WORKERS_MOST;
}

status contestants_finished(const sweep *s, fault *f)
{
    return s->unfinished == 0 ? STATUS_OK
                              : fault_set(f, STATUS_TIME_LIMIT, "stopped before %d cells were done",
                                          s->unfinished);
}
