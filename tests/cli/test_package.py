"""Install, Debian package, manual page, completion, uninstall."""
import os
import pathlib
import re
import subprocess
import unittest

import program
from program import ROOT, THRONG, FolderTest

BUILD = pathlib.Path(THRONG).parents[1]


# The scripts ask the program for names.
os.environ["PATH"] = f"{BUILD}/cli:{os.environ['PATH']}"


def run(*command, **options):
    return program.run(*command, **options).stdout


def commands():
    """Names that `throng help` lists."""
    text = run(THRONG, "help").split("Subcommands:")[1]
    return re.findall(r"^  ([a-z][a-z-]*)\s", text, re.M)


class Package(FolderTest):
    def complete(self, *words):
        script = self.folder / "throng.bash"
        script.write_text(run(THRONG, "completion", "bash"))
        quoted = " ".join(f"'{word}'" for word in ("throng", *words))
        return run(
            "bash",
            "-c",
            f"source {script}; COMP_WORDS=({quoted}); COMP_CWORD={len(words)}; _throng; echo ${{COMPREPLY[@]}}",
        ).split()

    def test_completion(self):
        self.assertEqual(self.complete("scen"), ["scenarios", "scenario"])
        self.assertEqual(self.complete("scenario", "ch"), ["check"])
        self.assertIn("--output", self.complete("run", "job.json", "--o"))
        self.assertNotIn("confined", self.complete(""))
        self.assertEqual(set(self.complete("")) - {"--help", "--version"}, set(commands()))
        for command in (("run", "--executor"), ("run", "job.json", "--executor"), ("run", "--executor", "=")):
            self.assertEqual(self.complete(*command, "")[-2:], ["local", "slurm"], command)
        self.assertEqual(self.complete("export", "out", "--formats", "yolo-d"), ["yolo-detect"])
        self.assertEqual(self.complete("export", "out", "--formats", "mot,kit"), ["mot,kitti"])
        self.assertEqual(self.complete("validate-crowd", "-m", "o"), ["orca"])
        self.assertEqual(self.complete("scenario", "plan", "city_square/ev"), ["city_square/everyday"])
        self.assertEqual(self.complete("airframes", "craz"), ["crazyflie"])
        self.assertEqual(self.complete("scenario", "generate", "--kind", "pl"), ["plaza"])

    def test_fish_completion(self):
        script = self.folder / "throng.fish"
        script.write_text(run(THRONG, "completion", "fish"))

        def complete(line):
            """Words that fish offers at the end of the line, with their descriptions."""
            lines = run("fish", "--no-config", "-c", f"source {script}; complete -C '{line}'", cwd=self.folder)
            return dict(line.partition("\t")[::2] for line in lines.splitlines())

        self.assertEqual(list(complete("throng scen")), ["scenario", "scenarios"])
        self.assertEqual(list(complete("throng scenario ch")), ["check"])
        self.assertIn("--output", complete("throng run job.json --o"))
        self.assertTrue(all(complete("throng scenario ").values()))
        self.assertEqual(set(complete("throng ")), set(commands()))
        self.assertEqual(list(complete("throng run job.json --executor ")), ["local", "slurm"])
        self.assertEqual(list(complete("throng export out --formats yolo-d")), ["yolo-detect"])
        self.assertEqual(list(complete("throng export out --formats mot,kit")), ["mot,kitti"])
        self.assertEqual(list(complete("throng validate-crowd -m o")), ["orca"])
        self.assertEqual(list(complete("throng scenario plan city_square/ev")), ["city_square/everyday"])
        self.assertEqual(list(complete("throng airframes craz")), ["crazyflie"])

    def test_zsh_completion(self):
        script = self.folder / "_throng"
        script.write_text(run(THRONG, "completion", "zsh"))

        def complete(*words):
            """Words that the function offers, with their descriptions; zsh itself sorts out those that fit."""
            line = " ".join(f"'{word}'" for word in ("throng", *words))
            printing = "compdef() { :; }; _files() { :; }; _describe() { print -rl -- ${(P)3}; }"
            printing += "; compset() { :; }; compadd() { shift; print -rl -- $@; }"
            output = run(
                "zsh", "-f", "-c", f"{printing}; source {script}; words=({line}) CURRENT={len(words) + 1}; _throng"
            )
            return dict((re.split(r"(?<!\\):", line, maxsplit=1) + [""])[:2] for line in output.splitlines())

        self.assertEqual(set(complete("")) - {"--help", "--version"}, set(commands()))
        self.assertIn("check", complete("scenario", ""))
        self.assertEqual(list(complete("run", "--executor", "")), ["local", "slurm"])
        self.assertIn("yolo-detect", complete("export", "out", "--formats", ""))
        self.assertIn("city_square/everyday", complete("scenario", "plan", ""))
        self.assertIn("--output", complete("run", "job.json", "--o"))
        self.assertTrue(all(complete("scenario", "").values()))

    def test_zsh_loads_the_completion_from_its_folder(self):
        (self.folder / "_throng").write_text(run(THRONG, "completion", "zsh"))
        loads = f"fpath=({self.folder} $fpath); autoload -Uz compinit; compinit -u -D; print -r -- $_comps[throng]"
        self.assertEqual(run("zsh", "-f", "-c", loads).strip(), "_throng")

    def test_the_manual_page_has_every_command_and_is_sound(self):
        page = run(THRONG, "manual")
        for command in commands():
            self.assertIn(f".SS throng {command}\n".replace("-", "\\-"), page)
        self.assertIn("\\fB\\-o,\\-\\-output\\fR TEXT REQUIRED\n", page)
        self.assertIn("\\fB\\-\\-executor\\fR TEXT:{local,slurm}\n", page)
        self.assertIn("\\fB\\-\\-profile\\fR\n", page)
        self.assertNotIn(str(ROOT), page)
        done = subprocess.run(["groff", "-man", "-Tascii", "-ww"], input=page, capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    @unittest.skipUnless(os.getuid() == 0, "only root may mount a layer over the sources and be another user")
    def test_packaging_and_installing_write_only_below_their_prefix(self):
        """Another user may write into the prefix and list what was installed; a layer over the sources shows the rest."""
        script = """set -e
            base="$(mktemp -d /tmp/throng-package.XXXXXX)"  # not below the sources
            mount -t tmpfs tmpfs "$base"
            chmod 777 "$base"
            cd "$base"
            mkdir written work
            mount -t overlay overlay -o "lowerdir=$1,upperdir=$base/written,workdir=$base/work" "$1"
            rm -f "$2"/install_manifest*.txt
            chown nobody "$2"  # cmake writes install_manifest*.txt there
            nobody() { setpriv --reuid nobody --regid nogroup --clear-groups env HOME="$base" "$@"; }
            {
              nobody cpack --config "$2/CPackConfig.cmake" -B "$base/package"
              for component in program library; do
                nobody cmake --install "$2" --prefix "$base/$component" --component $component
              done
            } >&2
            find package/*.deb program/bin/throng library/include/throng -maxdepth 0
            find written ! -type d
            umount "$1" && cd / && umount "$base" && rmdir "$base" """
        found = run("unshare", "--mount", "bash", "-c", script, "bash", ROOT, BUILD).splitlines()
        written = {path.rsplit("/", 1)[1] for path in found if path.startswith("written/")}
        self.assertEqual(written, {"install_manifest_program.txt", "install_manifest_library.txt"})
        self.assertEqual(sum(path.startswith("package/throng_") for path in found), 1)
        self.assertLess({"program/bin/throng", "library/include/throng"}, set(found))

    def test_install_and_uninstall(self):
        prefix = self.folder / "usr"
        build = self.folder / "build"
        build.mkdir()
        run("cmake", "--install", BUILD, "--prefix", prefix, "--component", "program")
        clean = {name: value for name, value in os.environ.items() if not name.startswith("THRONG_")}
        self.assertIn("city_square/nearest_exit", run(prefix / "bin/throng", "scenarios", env=clean))
        world = ROOT / "tests/places/imports/data/yard.sdf"  # imported by a program beside the installed one
        models = ROOT / "tests/places/imports/data/models"
        importing = ("scenario", "import", world, "-o", self.folder / "mine", "--models", models)
        run(prefix / "bin/throng", *importing, env=clean)
        self.assertTrue((self.folder / "mine/yard.json").is_file())
        for file in """
            throng/schemas/scenario.schema.json man/man1/throng.1 bash-completion/completions/throng
            zsh/vendor-completions/_throng fish/vendor_completions.d/throng.fish doc/throng/copyright
            doc/throng/NOTICE""".split():
            self.assertTrue((prefix / "share" / file).is_file(), file)
        installed = [str(file) for file in prefix.rglob("*") if file.is_file()]
        (build / "install_manifest_program.txt").write_text("\n".join(installed))
        run("cmake", "-P", ROOT / "cmake/Uninstall.cmake", cwd=build)
        self.assertEqual([file for file in prefix.rglob("*") if file.is_file()], [])
        self.assertFalse((prefix / "share/throng").exists())

    def test_the_debian_package(self):
        run("cpack", "--config", BUILD / "CPackConfig.cmake", "-B", self.folder)
        [package] = self.folder.glob("*.deb")
        self.assertRegex(package.name, r"^throng_[\d.]+_[a-z0-9]+\.deb$")
        depends = run("dpkg-deb", "-f", package, "Depends")
        for name in "libc6 libcholmod3 libsdformat12-12 libhdf5-103-1 libgl1-mesa-dri fonts-dejavu-core".split():
            self.assertIn(name, depends)
        files = run("dpkg-deb", "-c", package)
        for file in (
            "usr/bin/throng",
            "usr/libexec/throng/throng-import",
            "usr/share/throng/scenarios/city_square/nearest_exit.json",
            "usr/share/man/man1/throng.1",
        ):
            self.assertIn(file, files)
        self.assertNotIn("/include/", files)


unittest.main()
