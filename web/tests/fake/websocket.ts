/** The server's end of a WebSocket (RFC 6455), as far as browsers use it here: binary messages, close. */

import { createHash } from 'node:crypto';
import type { IncomingMessage } from 'node:http';
import type { Duplex } from 'node:stream';

const MAGIC = '258EAFA5-E914-47DA-95CA-C5AB0DC85B11';
const BINARY = 0x82;
const CLOSE = 8;

export interface Line {
  send(message: Uint8Array): void;
  close(): void;
}

/** Answers the upgrade; gives every message to `take`, and calls `ended` once. */
export function accept(
  request: IncomingMessage,
  socket: Duplex,
  take: (message: Buffer) => void,
  ended: () => void,
): Line {
  const key = createHash('sha1')
    .update(`${request.headers['sec-websocket-key'] ?? ''}${MAGIC}`)
    .digest('base64');
  const head = ['HTTP/1.1 101 Switching Protocols', 'Upgrade: websocket', 'Connection: Upgrade'];
  socket.write(`${head.join('\r\n')}\r\nSec-WebSocket-Accept: ${key}\r\n\r\n`);
  let pending = Buffer.alloc(0);
  socket.on('data', (piece: Buffer) => {
    pending = Buffer.concat([pending, piece]);
    for (let message = next(pending); message; message = next(pending)) {
      pending = pending.subarray(message.size);
      if (message.code === CLOSE) socket.end();
      else take(message.content);
    }
  });
  socket.on('error', () => socket.destroy());
  socket.on('close', ended);
  return { send: (message) => void (socket.writable && socket.write(framed(message))), close: () => void socket.end() };
}

function framed(message: Uint8Array): Buffer {
  const head = Buffer.alloc(message.length < 126 ? 2 : message.length < 65536 ? 4 : 10);
  head[0] = BINARY;
  head[1] = head.length === 2 ? message.length : head.length === 4 ? 126 : 127;
  if (head.length === 4) head.writeUInt16BE(message.length, 2);
  if (head.length === 10) head.writeBigUInt64BE(BigInt(message.length), 2);
  return Buffer.concat([head, message]);
}

/** The first whole message, without its mask. */
function next(bytes: Buffer): { code: number; content: Buffer; size: number } | null {
  if (bytes.length < 2) return null;
  const short = (bytes[1] ?? 0) & 0x7f;
  const lengthBytes = short === 126 ? 2 : short === 127 ? 8 : 0;
  if (bytes.length < 6 + lengthBytes) return null;
  const length =
    lengthBytes === 0 ? short : Number(lengthBytes === 2 ? bytes.readUInt16BE(2) : bytes.readBigUInt64BE(2));
  const at = 6 + lengthBytes;
  if (bytes.length < at + length) return null;
  const mask = bytes.subarray(at - 4, at);
  const content = bytes.subarray(at, at + length).map((byte, i) => byte ^ (mask[i % 4] ?? 0)) as Buffer;
  return { code: (bytes[0] ?? 0) & 0x0f, content, size: at + length };
}
