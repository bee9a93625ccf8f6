"""`myotact serve` on free ports, for the tests of clients."""
import os
import subprocess


class Server:
    def __init__(self, program, *arguments, token=""):
        self.process = subprocess.Popen([program, "serve", *arguments, "--port", "0", "--log-level", "off"],
                                        stdout=subprocess.PIPE, text=True, env={**os.environ, "MYOTACT_TOKEN": token})
        for line in self.process.stdout:
            word, address = line.split()
            if word == "tcp":
                self.host, port = address.rsplit(":", 1)
                self.port = int(port)
                return
        raise RuntimeError("the server did not start")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.wait(60)
        self.process.stdout.close()
