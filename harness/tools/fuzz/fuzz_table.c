/* Uses the input as the short table of a run. A table that was read must be written and read
 * again. */
#include "harness/records/records.h"
#include "harness/tools/fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    stored_results r = {0}, again = {0};
    fault f = {""};
    FILE *from = fuzz_stream(data, size);
    const status outcome = results_table_read("table", from, &r, &f);
    fclose(from);
    fuzz_must((outcome == STATUS_OK) == (f.text[0] == '\0') && strchr(f.text, '\n') == NULL,
              "a rejection has a one-line error");
    if (outcome == STATUS_OK) {
        char *written = NULL;
        size_t length = 0;
        FILE *to = open_memstream(&written, &length);
        fuzz_must(to != NULL, "there is memory");
        results_table_write(to, &r);
        fclose(to);
        from = fuzz_stream((const uint8_t *)written, length);
        fuzz_must(results_table_read("table", from, &again, &f) == STATUS_OK &&
                      again.seriess == r.seriess,
                  "written results can be read");
        fclose(from);
        free(written);
    }
    results_free(&again);
    results_free(&r);
    return 0;
}
