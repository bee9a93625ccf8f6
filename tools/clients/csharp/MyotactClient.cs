// A client of `myotact serve`: sends where the hand is and gets the newest force, and frames for SceneDecoder. No haptic
// loop: a device at 1 kHz belongs to `myotact feel`. One thread, or one that reads and one that sends. All that can go wrong
// is a WireException.
using System;
using System.Diagnostics;
using System.Globalization;
using System.IO;
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
        const int WelcomeBytes = 31, ForceBytes = 40;
        const int ConnectWaitMs = 2000, ReadWaitMs = 60000, SendWaitMs = 5000;

        readonly string address;
        readonly TcpClient socket = new TcpClient { NoDelay = true, ReceiveTimeout = ReadWaitMs, SendTimeout = SendWaitMs };
        readonly NetworkStream stream;
        uint sent, got;

        public uint Number { get; private set; }
        public int Hand { get; private set; }  // index of the scene's tool, -1: none is free
        public bool IsLockstep { get; private set; }
        public string SceneJson { get; private set; }
        /// When set: called with the bytes of every frame that comes.
        public Action<byte[]> OnBytes;

        public MyotactClient(string host, int port, Role role, Wants wants, byte[] token = null)
        {
            address = host + ":" + port;
            try
            {
                stream = Connect(host, port);
                Send(Wire.Hello((byte)role, (byte)wants, 0, 0, token ?? new byte[16], "csharp"), 0);
                byte[] welcome = Expect(FrameType.Welcome, WelcomeBytes).Payload;
                Number = BitConverter.ToUInt32(welcome, 0);
                Hand = (sbyte)welcome[12];
                IsLockstep = welcome[14] == 1;
                SceneJson = Encoding.UTF8.GetString(Expect(FrameType.Control, 0).Payload);
            }
            catch (WireException)
            {
                socket.Close();
                throw;
            }
        }

        public void Dispose()
        {
            try { Send(new Frame { Type = FrameType.Bye, Payload = new byte[] { 0 } }, 0); }
            catch (WireException) { }  // it is gone already
            socket.Close();
        }

        /// A token as the server prints it; no text: no token.
        public static byte[] TokenOf(string text)
        {
            var token = new byte[16];
            if (string.IsNullOrEmpty(text)) return token;
            bool isRight = text.Length == 32;
            for (int i = 0; i < 16 && isRight; ++i)
                isRight = byte.TryParse(text.Substring(2 * i, 2), NumberStyles.AllowHexSpecifier, CultureInfo.InvariantCulture,
                                        out token[i]);
            if (!isRight) throw new WireException("a token is 32 hexadecimal digits, as the server prints it");
            return token;
        }

        public static ulong NowNs()
        {
            return (ulong)(Stopwatch.GetTimestamp() * (1e9 / Stopwatch.Frequency));
        }

        public void SendState(ToolState state, ulong timeNs)
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

        public bool HasFrame
        {
            get
            {
                try { return stream.DataAvailable; }
                catch (Exception why) when (IsOfConnection(why)) { throw Failure(why.Message); }
            }
        }

        /// The next frame. Throws, too, when the server said good-bye.
        public Frame Read()
        {
            var head = Take(Wire.HeaderBytes);
            uint length = BitConverter.ToUInt32(head, 4);
            if (head[0] != 0x4D || length > Wire.MostPayload) throw Failure("what answers there speaks another protocol");
            var bytes = new byte[Wire.HeaderBytes + length];
            head.CopyTo(bytes, 0);
            Take((int)length).CopyTo(bytes, Wire.HeaderBytes);
            Frame frame = Wire.Parse(bytes);
            if (frame.Sequence != got++) throw Failure("a frame is missing");
            if (OnBytes != null) OnBytes(bytes);
            if (frame.Type == FrameType.Bye)
                throw Failure(frame.Payload.Length > 1 ? Encoding.UTF8.GetString(frame.Payload, 1, frame.Payload.Length - 1)
                                                       : "the server said good-bye");
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
            if (frame.Type != FrameType.Force || frame.Payload.Length < ForceBytes) throw new WireException("no force");
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
            try { stream.Write(bytes, 0, bytes.Length); }
            catch (Exception why) when (IsOfConnection(why)) { throw Failure(why.Message); }
        }

        Frame Expect(FrameType type, int leastBytes)
        {
            Frame frame = Read();
            if (frame.Type != type || frame.Payload.Length < leastBytes)
                throw Failure("a frame of type " + frame.Type + " where " + type + " was due");
            return frame;
        }

        byte[] Take(int count)
        {
            var bytes = new byte[count];
            for (int done = 0; done < count;)
            {
                int part = Part(bytes, done);
                if (part == 0)
                    throw Failure(got > 0 ? "the server closed the connection"
                                          : "closed without a word; is this the TCP port of `myotact serve`?");
                done += part;
            }
            return bytes;
        }

        int Part(byte[] bytes, int done)
        {
            try { return stream.Read(bytes, done, bytes.Length - done); }
            catch (Exception why) when (IsOfConnection(why)) { throw Failure(why.Message); }
        }

        NetworkStream Connect(string host, int port)
        {
            if (string.IsNullOrEmpty(host) || port < 1 || port > 65535) throw Failure("is no host with a port of 1 to 65535");
            const string Remedy = "; is `myotact serve` running there, and is this its port?";
            try
            {
                IAsyncResult connecting = socket.BeginConnect(host, port, null, null);
                if (!connecting.AsyncWaitHandle.WaitOne(ConnectWaitMs)) throw Failure("no answer" + Remedy);
                socket.EndConnect(connecting);
                return socket.GetStream();
            }
            catch (SocketException why)
            {
                throw Failure(why.Message + Remedy);
            }
        }

        static bool IsOfConnection(Exception why)
        {
            return why is IOException || why is SocketException || why is ObjectDisposedException;
        }

        WireException Failure(string why)
        {
            return new WireException(address + ": " + why);
        }
    }
}
