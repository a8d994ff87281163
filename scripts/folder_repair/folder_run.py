# SPDX-License-Identifier: MIT
"""A run: everything between the first look at IN_DIR and the summary.

One thread does it all: it begins files, and sleeps until one ends, a signal comes, or a limit is due.
"""

import collections
import errno
import os
import selectors
import signal
import subprocess
import sys
import time

from .archive import Lost
from .archive_inputs import ArchiveInputs, MemberJob, NotUnpacked
from .basics import (DONE, FINAL, INPUT, INTERNAL, KILLED, LIMIT, NAME, NO_SOLID, NOT_CERTIFIED, OUTPUT, WRITTEN, Stop,
                     key_of, names_of, bytes_of, print_to, say, text, unpacked, value_of)
from .gallery import (FOLDER as GALLERY, INDEX, as_html, facts_of, is_gallery, options_for, place_of,
                      row_of)
from .inputs import Job, find_meshes, listed_meshes, name_outputs, names_listed
from .job_server import JobServer
from .journal import Journal
from .own_names import SUMMARY, SUMMARY_TABLE, own_name_of
from .pictures import HOLD_PICTURES, NAME_PICTURES, pictures_of
from .summary import PackedRows, Progress, as_csv, as_json, table, totals_of
from .worker import Worker

TICK_SECONDS = 0.25  # how often limits are looked at
FLUSH_SECONDS = 0.25  # how long what is finished may be in no line of the journal
LONGEST_NAME = 200  # that is said of a file that a mesh names
SECONDS_TO_END = 0.3  # from a signal to this script until its workers are killed


class FolderRun:
    def __init__(self, options, program, out):
        self.options = options
        self.out = out
        self.started = self.flushed = time.monotonic()
        self.stop_signal = None
        self.selector = selectors.DefaultSelector()
        self.catch_signals()
        self.program = program.path
        self.options_of_all = self.options_of_workers()
        self.server = None
        self.settings = [program.version, program.digest, options.format or "", *(["--html"] if options.html else []),
                         *(os.fsencode(a).decode("utf-8", "surrogateescape") for a in options.passed)]
        self.workers, self.rows, self.serial = {}, {}, 0
        self.inputs = None  # of an archive

    def options_of_workers(self):
        """What does not differ from file to file."""
        options = self.options
        threads = max(1, len(os.sched_getaffinity(0)) // options.jobs)
        memory = f"{max(1, options.max_memory >> 20)}M" if options.max_memory else "0"
        return ["--quiet", "--threads", str(threads), "--time-limit", f"{options.timeout:.10g}", "--max-memory", memory, *options.passed,
                *(options_for(options.passed) if options.html else [])]

    def catch_signals(self):
        """Signals are noted, and wake up what waits."""
        reader, writer = os.pipe2(os.O_NONBLOCK | os.O_CLOEXEC)
        signal.set_wakeup_fd(writer, warn_on_full_buffer=False)
        self.selector.register(reader, selectors.EVENT_READ)
        signal.signal(signal.SIGCHLD, lambda number, frame: None)
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            if signal.getsignal(number) != signal.SIG_IGN:
                signal.signal(number, self.note_signal)

    def note_signal(self, number, _):
        self.stop_signal = self.stop_signal or number

    def stop_if_told(self):
        if self.stop_signal:
            how = "interrupted" if self.stop_signal == signal.SIGINT else "terminated"
            raise Stop(128 + self.stop_signal, how)

    def run(self):
        """Returns the exit code."""
        options, shard = self.options, self.options.shard
        jobs, left_out = self.find_jobs()
        if not options.restart:
            self.out.refuse_foreign_files(jobs, [INDEX, GALLERY] if options.html and not shard else [])
        self.names_of_jobs = {job.name for job in jobs}
        others = [self.out.main_journal] if shard else self.out.journals_of_shards()
        self.journal = Journal(self.out.path, self.out.journal_path, self.settings, options.restart, others,
                               shard.holds if shard else None)
        if others and not shard:
            self.journal.take_over(others)
            self.out.drop_shards()
        left = list(self.without_finished(jobs))
        self.queue = collections.deque(self.inputs.in_order(left) if self.inputs else left)
        self.tell_start(jobs, left_out)
        if not options.merge:
            self.work_through(jobs)
        return self.sum_up(jobs, left_out)

    def find_jobs(self):
        options = self.options
        if options.archive:
            self.inputs = ArchiveInputs(options.archive, self.out.work, options.timeout)
            meshes, left_out = self.inputs.read(lambda: self.stop_signal)
            if options.list is not None:
                meshes, left_out = self.inputs.listed(names_listed(options.list, options.in_dir))
        elif options.list is None:
            meshes, left_out = find_meshes(options.in_dir, self.out.path, lambda: self.stop_signal)
        else:
            meshes, left_out = listed_meshes(options.list, options.in_dir, self.out.path)
        self.stop_if_told()
        outputs = name_outputs(meshes, options.format)
        if options.shard:
            meshes = {name: mesh for name, mesh in meshes.items() if options.shard.holds(name)}
        for name in [name for name in meshes if own_name_of(outputs[name])]:
            del meshes[name]
            left_out[name] = Lost(f"{text(own_name_of(outputs[name]))} in OUT_DIR is made by {NAME}: rename its folder")
        if options.archive:
            return [MemberJob(name, mesh, outputs[name], options, self.inputs) for name, mesh in meshes.items()], left_out
        return [Job(name, mesh, outputs[name], options) for name, mesh in meshes.items()], left_out

    def work_through(self, jobs):
        failed = sum(unpacked(row)["exit_code"] != DONE for row in self.rows.values())
        self.progress = Progress(len(jobs), len(self.rows), failed, self.options.quiet)
        try:
            self.work()
        finally:
            self.end_workers()
            self.progress.clear()

    def without_finished(self, jobs):
        for job in jobs:
            self.stop_if_told()
            try:
                job.look()
            except OSError:
                pass  # said when its turn comes
            row = self.journal.finished_row(job, also_failed=self.options.merge)
            if row:
                self.rows[job.name] = row
            else:
                yield job

    def tell_start(self, jobs, left_out):
        for name, why in sorted(left_out.items()):
            if not self.options.quiet or name.endswith(b"/") or isinstance(why, Lost):
                say(f"{text(name)}: left out: {why}")
        if self.options.quiet:
            return
        if not jobs:
            say(f"no mesh files in {text(self.options.in_dir)}")
        elif self.rows:
            say(f"{len(self.rows):,} of {len(jobs):,} files were finished before")
        gone = set() if self.options.list else self.journal.outputs() - {job.output for job in jobs}
        for name in sorted(gone):
            if os.path.lexists(os.path.join(self.out.path, name)):
                say(f"warning: {text(name)} in OUT_DIR is of an earlier run, and of no input now")

    def work(self):
        while (self.queue or self.workers) and not self.stop_signal:
            while self.queue and len(self.workers) < self.options.jobs:
                self.start(self.queue.popleft())
            self.attend(TICK_SECONDS if self.workers else 0)
            if time.monotonic() > self.flushed + FLUSH_SECONDS:
                self.flush()
        self.flush()

    def flush(self):
        """Outputs, then the lines that tell of them. For many at a time: to wait for the disk may take longer than a repair."""
        self.out.sync()
        try:
            self.journal.flush()
        except OSError as error:
            raise Stop(OUTPUT, f"{text(self.out.journal_path)}: cannot be written: {error.strerror}") from None
        self.flushed = time.monotonic()

    def attend(self, seconds):
        """To the workers, for so long if nothing happens."""
        self.wait(seconds)
        for serial, worker in list(self.workers.items()):
            if worker.has_ended(self.program, self.out.locks):
                del self.workers[serial]
                self.finish(worker)
            elif not worker.enforce(self.options):
                del self.workers[serial]
                self.settle(worker.job, worker.job.row(LIMIT, "cannot be killed"), final=False)
                self.end_server()  # its place there would stay taken
        self.progress.draw()

    def start(self, job):
        try:
            job.look()
        except OSError as error:
            # Permissions and links change without a trace in the file, so this is not final.
            return self.settle(job, job.row(INPUT, f"cannot be opened: {error.strerror}"), final=False)
        self.serial += 1
        job.trials += 1
        folder = os.path.join(self.out.work, b"%d" % self.serial)
        os.mkdir(folder)
        if not self.unpack(job, folder + b".in"):
            return None
        try:
            self.start_server()
        except (OSError, subprocess.SubprocessError) as error:
            job.clear()
            row = job.row(INTERNAL, f"meshrepair cannot be started: {error}")
            return self.settle(job, row, final=False)
        self.workers[self.serial] = Worker(job, self.server, self.serial, folder, self.options.html)
        return None

    def start_server(self):
        """If there is none."""
        if not self.server:
            self.server = JobServer(self.program, self.options_of_all, self.options.jobs, self.out.locks)
            self.selector.register(self.server.answers, selectors.EVENT_READ, self.server)

    def end_server(self):
        """What has no answer is told that it was killed."""
        if not self.server:
            return
        server, self.server = self.server, None
        self.selector.unregister(server.answers)
        answer = server.last_answer()
        for worker in self.workers.values():
            if worker.server is server and worker.answer is None:
                worker.take(answer)

    def unpack(self, job, folder):
        """Whether it is ready, and is to be begun. Meanwhile the other workers are attended to."""
        try:
            for _ in job.unpack(folder):
                self.attend(0)
                if self.stop_signal:
                    return False
            return True
        except NotUnpacked as error:
            job.clear()
            self.settle(job, job.row(error.code, str(error)), final=False)
            return False

    def wait(self, seconds):
        """Until something happens, but not for long."""
        for key, _ in self.selector.select(seconds):
            if key.data is None:
                os.read(key.fd, 4096)
            else:
                self.take_answers(key.data.listen())

    def take_answers(self, answers):
        if answers is None:
            return self.end_server()
        for answer in answers:
            worker = self.workers.get(answer["id"])
            if worker:
                worker.take(answer)
        return None

    def finish(self, worker):
        job = worker.job
        code, error, report = worker.judge()
        # Somebody, or the system for want of memory, has killed it: once more, after all others.
        if code == KILLED and job.trials == 1:
            self.queue.append(job)
            return self.clear(worker)
        names = names_of(report, "files") + names_of(report, "pictures")
        if job.lacks(names):
            job.trials -= 1
            self.queue.append(job)
            return self.clear(worker)
        row = job.row(code, error, report)
        job.note_needs(names)
        if code in WRITTEN and os.path.isfile(worker.mesh):
            row = self.take_output(worker, row, report)
        elif row["exit_code"] == NO_SOLID:
            self.take_pages(worker, report)
        row["seconds"] = round(time.monotonic() - worker.started, 3)
        row["peak_memory_bytes"] = value_of(report, "peak_memory_bytes") or worker.peak_memory
        self.clear(worker)
        # What cannot be read may lack a buffer; which one, no report says.
        lacks_others = row["exit_code"] == INPUT and job.reads_others
        self.settle(job, row, final=row["exit_code"] in FINAL and not lacks_others)

    @staticmethod
    def clear(worker):
        worker.clear()
        worker.job.clear()

    def take_output(self, worker, row, report):
        """The row with what is known of the output."""
        job = worker.job
        try:
            size = os.path.getsize(worker.mesh)
            self.take_files_beside(worker)
            self.take_pictures(job, report)
            self.take_pages(worker, report)
            self.out.take(worker.mesh, job.target)
        except OSError as error:
            return job.row(OUTPUT, f"{text(job.output)}: cannot be written: {error.strerror}")
        return {**row, "output": text(job.output), "bytes_out": size,
                "triangles_out": value_of(report, "result", "triangles")}

    def take_files_beside(self, worker):
        """First, so that what the mesh names is there. Files of one name are of one output alone, unless they
        are the same."""
        job = worker.job
        for made in worker.files_beside():
            target = os.path.join(os.path.dirname(job.target), os.path.basename(made))
            name = os.path.relpath(target, self.out.path)
            if not self.out.holds_same(made, target):
                if self.is_of_another(name, target, job):
                    raise OSError(errno.EEXIST, f"{text(name)}, which it needs beside it, is of another")
                self.out.take(made, target)
            job.beside[name] = os.path.getsize(target)

    def take_pictures(self, job, report):
        """Those that lie in IN_DIR; names of others are said, as the result may look otherwise."""
        if job.format not in NAME_PICTURES + HOLD_PICTURES:
            return
        pictures, outside, displaced = pictures_of(job, job.root, report)
        for place, path in pictures.items():
            target = os.path.join(self.out.path, place)
            if not self.out.holds_same(path, target):
                if self.is_of_another(place, target, job, of_pictures=False):
                    raise OSError(errno.EEXIST, f"{text(place)}, which it names, is of another")
                self.out.take_copy(path, target)
            job.pictures[place] = os.path.getsize(target)
        self.warn(job, outside, "outside of IN_DIR: does not come along")
        self.warn(job, displaced, "whose place in OUT_DIR is kept for what is made there: does not come along")
        self.warn(job, job.missing(), "which is not there")

    def take_pages(self, worker, report):
        """Those of the gallery."""
        job = worker.job
        for ending, made in worker.pages.items():
            if os.path.isfile(made):
                name = place_of(job, ending)
                job.shown[name] = os.path.getsize(made)
                self.out.take(made, os.path.join(self.out.path, name))
        job.facts = facts_of(report)

    def warn(self, job, names, why):
        if names and not self.options.quiet:
            more = f" and {len(names) - 1:,} more" if len(names) > 1 else ""
            self.progress.clear()
            first = names[0] if len(names[0]) <= LONGEST_NAME else names[0][:LONGEST_NAME] + "..."
            say(f"{text(job.name)}: warning: names {first}{more}, {why}")

    def is_of_another(self, name, target, job, of_pictures=True):
        """Of an output of this run, or not from this script. A picture may be of several outputs."""
        if any(bytes_of(key) in self.names_of_jobs for key in self.journal.others_with(name, job, of_pictures)):
            return True
        is_known = key_of(name) in self.journal.owners
        return self.out.is_new and not self.options.restart and not is_known and os.path.lexists(target)

    def settle(self, job, row, final):
        """The row is the last word on the job in this run."""
        try:
            self.remove_old(job, is_written=row["output"] is not None)
        except OSError as error:
            row["error"] = f"{row['error'] or ''}; its old output cannot be removed: {error.strerror}".lstrip("; ")
        self.rows[job.name] = self.journal.add(job, row, final)
        self.progress.finished(row)

    def remove_old(self, job, is_written):
        """What an earlier run has made and this one has not."""
        old, new = self.journal.files_beside(job), job.beside.keys() | job.pictures.keys() | job.shown.keys()
        old = old - new if is_written else (old | new) - job.shown.keys()
        for name in old:
            if not self.journal.others_with(name, job):
                self.out.remove(os.path.join(self.out.path, name))
        if not is_written:
            self.out.remove(job.target)

    def end_workers(self):
        """Those that are left when the run ends early."""
        for worker in self.workers.values():
            if worker.looker:
                worker.cancel(0)
        if self.server and self.workers:
            self.server.signal(signal.SIGTERM)
            self.server.wait(SECONDS_TO_END)
        if self.server:
            self.end_server()
        self.workers.clear()
        self.out.clear_work()

    def sum_up(self, jobs, left_out):
        rows = PackedRows([self.rows[job.name] for job in jobs if job.name in self.rows])
        totals = totals_of(rows, len(jobs) - len(rows))
        elapsed = time.monotonic() - self.started
        # That of a shard is no summary of OUT_DIR.
        folder = self.out.state if self.options.shard else self.out.path
        self.out.write(SUMMARY_TABLE, as_csv(rows), folder)
        self.out.write(SUMMARY, as_json(rows, totals, left_out, self.settings, elapsed), folder)
        if not self.options.shard:
            self.write_gallery(jobs, totals)
        if not self.options.quiet:
            print_to(sys.stdout, table(totals, elapsed))
        self.stop_if_told()
        has_lost = any(name.endswith(b"/") or isinstance(why, Lost) for name, why in left_out.items())
        all_passed = set(totals["by_exit_code"]) <= {str(DONE)} and not has_lost and not totals["not_done"]
        return DONE if all_passed else NOT_CERTIFIED

    def write_gallery(self, jobs, totals):
        """One of an earlier run, whose pages are gone, does not stay."""
        if self.options.html:
            rows = [row_of(job, unpacked(self.rows[job.name]), self.journal.entry_of(job)) for job in jobs if job.name in self.rows]
            self.out.write(INDEX, [as_html(rows, self.settings, totals)])
        elif is_gallery(index := os.path.join(self.out.path, INDEX)):
            self.out.remove(index)
