"""import_in_three.py CHROMIUM ROOM PICTURE: what gltf_imports.sh runs, in a folder with ROOM, camera.json and three.js.

Serves the folder to a browser without a screen, and keeps the picture that import_in_three.html sends back.
"""

import http.server
import subprocess
import sys
import tempfile
import threading

PATIENCE = 120  # seconds

chromium, room, picture = sys.argv[1:]
received = threading.Event()


class Folder(http.server.SimpleHTTPRequestHandler):
    def do_PUT(self):
        with open(picture, "wb") as file:
            file.write(self.rfile.read(int(self.headers["Content-Length"])))
        self.send_response(204)
        self.end_headers()
        received.set()

    def log_message(self, *_):
        pass


server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Folder)
threading.Thread(target=server.serve_forever, daemon=True).start()
with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
    browser = subprocess.Popen(
        [chromium, "--headless", "--no-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking",
         "--disable-component-update", "--disable-sync", "--enable-unsafe-swiftshader", "--use-angle=swiftshader",
         f"--user-data-dir={profile}", "--remote-debugging-port=0",
         f"http://127.0.0.1:{server.server_port}/import_in_three.html?{room}"],
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    done = received.wait(PATIENCE)
    browser.terminate()
    browser.wait()
sys.exit(0 if done else 1)
