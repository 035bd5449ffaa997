/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Figures of a row of --each: columns before those of the result, and the answer of a row that failed. */
#include "figures_parts.h"

VALUE(failed_format, row_state, TEXT, WORD("ceduo-failed-1"))
VALUE(row_status, row_state, TEXT, WORD(o->reason ? "failed" : "ok"))
VALUE(failed_class, row_state, COUNT, COUNT(CEDUO_CLASS_NOT_JUDGED))

#define REASON                                                                                                                 \
    {                                                                                                                          \
        "reason", "", "why the row failed: its first error", MEMBER(row_state, reason), .null = "the row did not fail"         \
    }

const struct ceduo_figure ceduo_row_figures[] = {
    {"status", "", "with --each: ok or failed; a row that failed has no figures", .value = row_status},
    REASON,
    {"run", "",
     "hash of version, options and all files and values that the scene was read from: equal hashes, equal figures; printed "
     "only if --columns names it",
     MEMBER(row_state, run)},
    END};

const struct ceduo_figure ceduo_failed_figures[] = {
    {"format", "", "always ceduo-failed-1", .value = failed_format}, VERSION, REASON, END};

static const struct ceduo_figure failed_verdict[] = {
    {"class", "", "", .value = failed_class}, {"why", "", "", .value = row_status}, END};
const struct ceduo_figure ceduo_failed_columns[] = {{"verdict", "", "", .table = failed_verdict}, VERSION, END};
