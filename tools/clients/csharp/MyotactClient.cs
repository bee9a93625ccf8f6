// A client of `myotact serve`: tells where the hand is and gets the newest force, and frames for SceneDecoder. No haptic loop: a
// device at 1 kHz belongs to `myotact feel`. One thread, or one that reads and one that tells.
using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.Net.Sockets;
using System.Text;

namespace Myotact
{
    public enum Role : byte { Viewer, Student, Instructor }

    [Flags]
    public enum Wants : byte { Nothing = 0, Hand = 1, Frames = 2, Readings = 4, Meshes = 8 }

    public struct Force
    {
        public ulong ToolSequence, Step;
        public double[] WorldN;
    }

    public sealed class MyotactClient : IDisposable
    {
        readonly TcpClient socket;
        readonly NetworkStream stream;
        uint sent, got;

        public uint Number { get; private set; }
        public int Hand { get; private set; }  // index of the scene's tool, -1: none is free
        public bool IsLockstep { get; private set; }
        public string SceneJson { get; private set; }
        /// When set: called with the bytes of every frame that comes.
        public Action<byte[]> OnBytes;

        /// Throws SocketException or WireException.
        public MyotactClient(string host, int port, Role role, Wants wants, byte[] token = null)
        {
            socket = new TcpClient(host, port) { NoDelay = true, ReceiveTimeout = 60000, SendTimeout = 5000 };
            stream = socket.GetStream();
            Send(Wire.Hello((byte)role, (byte)wants, 0, 0, token ?? new byte[16], "csharp"), 0);
            byte[] welcome = Expect(FrameType.Welcome).Payload;
            Number = BitConverter.ToUInt32(welcome, 0);
            Hand = (sbyte)welcome[12];
            IsLockstep = welcome[14] == 1;
            SceneJson = Encoding.UTF8.GetString(Expect(FrameType.Control).Payload);
        }

        public void Dispose()
        {
            try { Send(new Frame { Type = FrameType.Bye, Payload = new byte[] { 0 } }, 0); }
            catch (Exception) { }  // it is gone already
            socket.Close();
        }

        public static ulong NowNs()
        {
            return (ulong)(Stopwatch.GetTimestamp() * (1e9 / Stopwatch.Frequency));
        }

        public void Tell(ToolState state, ulong timeNs)
        {
            foreach (Frame frame in Wire.Frames(state)) Send(frame, timeNs);
        }
        public void Ping()
        {
            Send(new Frame { Type = FrameType.Ping, Payload = BitConverter.GetBytes(NowNs()) }, NowNs());
        }
        public void Control(string json)
        {
            Send(new Frame { Type = FrameType.Control, Payload = Encoding.UTF8.GetBytes(json) }, NowNs());
        }
        /// Takes the force from everybody's hand.
        public void StopForces()
        {
            Send(new Frame { Type = FrameType.Event, Payload = new byte[] { 1, 0, 0, 0, 0 } }, NowNs());
        }

        public bool HasFrame { get { return stream.DataAvailable; } }

        /// The next frame. Throws WireException when the server said good-bye or broke a rule.
        public Frame Read()
        {
            var head = Take(Wire.HeaderBytes);
            uint length = BitConverter.ToUInt32(head, 4);
            if (head[0] != 0x4D || length > Wire.MostPayload) throw new WireException("no frame of this format");
            var bytes = new byte[Wire.HeaderBytes + length];
            head.CopyTo(bytes, 0);
            Take((int)length).CopyTo(bytes, Wire.HeaderBytes);
            Frame frame = Wire.Parse(bytes);
            if (frame.Sequence != got++) throw new WireException("a frame is missing");
            if (OnBytes != null) OnBytes(bytes);
            if (frame.Type == FrameType.Bye)
                throw new WireException(Encoding.UTF8.GetString(frame.Payload, 1, frame.Payload.Length - 1));
            return frame;
        }

        public Frame ReadUntil(FrameType type)
        {
            Frame frame = Read();
            while (frame.Type != type) frame = Read();
            return frame;
        }

        public static Force ForceOf(Frame frame)
        {
            var force = new Force
            {
                ToolSequence = BitConverter.ToUInt64(frame.Payload, 0), Step = BitConverter.ToUInt64(frame.Payload, 8),
                WorldN = new double[3]
            };
            for (int i = 0; i < 3; ++i) force.WorldN[i] = BitConverter.ToDouble(frame.Payload, 16 + 8 * i);
            return force;
        }

        void Send(Frame frame, ulong timeNs)
        {
            frame.Sequence = sent++;
            frame.TimeNs = timeNs;
            byte[] bytes = Wire.Bytes(frame);
            stream.Write(bytes, 0, bytes.Length);
        }

        Frame Expect(FrameType type)
        {
            Frame frame = Read();
            if (frame.Type != type) throw new WireException("a frame of type " + frame.Type + " where " + type + " was due");
            return frame;
        }

        byte[] Take(int count)
        {
            var bytes = new byte[count];
            for (int done = 0; done < count;)
            {
                int part = stream.Read(bytes, done, count - done);
                if (part == 0) throw new WireException("the server closed the connection");
                done += part;
            }
            return bytes;
        }
    }
}
