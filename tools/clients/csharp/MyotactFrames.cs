// The wire format of src/net/README.md, version 1, for C# 7 without engine types. SI units, world frame: right-handed,
// x cranial, y left, z up.
using System;
using System.Collections.Generic;
using System.IO;
using System.Text;

namespace Myotact
{
    public enum FrameType : byte
    {
        Hello = 1, Welcome, ToolState, ToolContact, ToolGrip, Force, Event, Ping, Pong, Bye,
        LocalModel = 16, SceneKey, SceneDelta, BonePoses, Readings, Mesh, Control = 32
    }

    public sealed class WireException : Exception
    {
        public WireException(string why) : base(why) { }
    }

    public struct Frame
    {
        public FrameType Type;
        public byte Flags;
        public uint Sequence;
        public ulong TimeNs;
        public byte[] Payload;
    }

    /// What a place of a muscle or bone is touched by.
    public sealed class Contact
    {
        public int Surface, Triangle;
        public double[] Barycentric = new double[3];
        public double[] NormalWorld = new double[3];
        public double[] TargetWorldM = new double[3];
        public double StiffnessNPerM;
        public double[] TouchedWorldM = new double[3];
    }

    /// A muscle line or a point of a body in hand; -1: none.
    public sealed class Grip
    {
        public int Line = -1, Body = -1;
        public double LineFraction, LineStiffnessNPerM;
        public double[] BodyPointRestM = new double[3];
        public double[] BodyTargetWorldM = new double[3];
        public double BodyStiffnessNPerM;
    }

    public sealed class ToolState
    {
        public double[] PositionWorldM = new double[3];
        public double[] ProxyWorldM = new double[3];
        public double[] ForceWorldN = new double[3];
        public ulong Sequence, ModelSequence;
        public uint Buttons, Faults;
        public Contact Contact;
        public Grip Grip;
    }

    public static class Wire
    {
        public const int HeaderBytes = 24, MostPayload = 1 << 20;
        const byte Magic = 0x4D, Version = 1;
        static readonly uint[] CrcTable = MakeCrcTable();

        static uint[] MakeCrcTable()
        {
            var table = new uint[256];
            for (uint i = 0; i < 256; ++i)
            {
                uint c = i;
                for (int bit = 0; bit < 8; ++bit) c = (c & 1) != 0 ? 0xEDB88320u ^ (c >> 1) : c >> 1;
                table[i] = c;
            }
            return table;
        }

        static uint Crc(uint crc, byte[] bytes, int begin, int count)
        {
            for (int i = begin; i < begin + count; ++i) crc = CrcTable[(crc ^ bytes[i]) & 0xFF] ^ (crc >> 8);
            return crc;
        }

        static uint CrcOf(byte[] bytes)
        {
            uint crc = Crc(0xFFFFFFFFu, bytes, 0, 20);
            return Crc(crc, bytes, HeaderBytes, bytes.Length - HeaderBytes) ^ 0xFFFFFFFFu;
        }

        /// BinaryWriter and BitConverter write as the wire does on little-endian machines, which all engines' are.
        public static byte[] Bytes(Frame frame)
        {
            var bytes = new byte[HeaderBytes + frame.Payload.Length];
            using (var writer = new BinaryWriter(new MemoryStream(bytes)))
            {
                writer.Write(Magic);
                writer.Write(Version);
                writer.Write((byte)frame.Type);
                writer.Write(frame.Flags);
                writer.Write((uint)frame.Payload.Length);
                writer.Write(frame.Sequence);
                writer.Write(frame.TimeNs);
            }
            frame.Payload.CopyTo(bytes, HeaderBytes);
            BitConverter.GetBytes(CrcOf(bytes)).CopyTo(bytes, 20);
            return bytes;
        }

        /// The one frame that `bytes` is. Throws WireException.
        public static Frame Parse(byte[] bytes)
        {
            if (bytes.Length < HeaderBytes || bytes[0] != Magic || bytes[1] != Version)
                throw new WireException("no frame of this format");
            var payload = new byte[bytes.Length - HeaderBytes];
            Array.Copy(bytes, HeaderBytes, payload, 0, payload.Length);
            if (BitConverter.ToUInt32(bytes, 4) != payload.Length || BitConverter.ToUInt32(bytes, 20) != CrcOf(bytes))
                throw new WireException("a frame of another length or check sum than it says");
            return new Frame
            {
                Type = (FrameType)bytes[2], Flags = bytes[3], Sequence = BitConverter.ToUInt32(bytes, 8),
                TimeNs = BitConverter.ToUInt64(bytes, 12), Payload = payload
            };
        }

        static void Write(BinaryWriter writer, params double[] numbers)
        {
            foreach (double number in numbers) writer.Write(number);
        }

        static Frame Make(FrameType type, byte flags, Action<BinaryWriter> fill)
        {
            var stream = new MemoryStream();
            using (var writer = new BinaryWriter(stream)) fill(writer);
            return new Frame { Type = type, Flags = flags, Payload = stream.ToArray() };
        }

        public static Frame Hello(byte role, byte wants, byte hand, ulong resumeId, byte[] token, string name)
        {
            return Make(FrameType.Hello, 0, w =>
            {
                w.Write((ushort)1);
                w.Write(role);
                w.Write(wants);
                w.Write(hand);
                w.Write(resumeId);
                w.Write(token);
                w.Write(Encoding.UTF8.GetBytes(name));
            });
        }

        /// A state and what it touches and holds, in the order in which they go out.
        public static List<Frame> Frames(ToolState state)
        {
            var frames = new List<Frame>();
            byte flags = 0;
            if (state.Contact != null)
            {
                flags |= 1;
                Contact c = state.Contact;
                frames.Add(Make(FrameType.ToolContact, 0, w =>
                {
                    w.Write(c.Surface);
                    w.Write(c.Triangle);
                    Write(w, c.Barycentric[0], c.Barycentric[1]);
                    Write(w, c.NormalWorld);
                    Write(w, c.TargetWorldM);
                    Write(w, c.StiffnessNPerM);
                    Write(w, c.TouchedWorldM);
                }));
            }
            if (state.Grip != null)
            {
                flags |= 2;
                Grip g = state.Grip;
                frames.Add(Make(FrameType.ToolGrip, 0, w =>
                {
                    w.Write(g.Line);
                    w.Write(g.Body);
                    Write(w, g.LineFraction, g.LineStiffnessNPerM);
                    Write(w, g.BodyPointRestM);
                    Write(w, g.BodyTargetWorldM);
                    Write(w, g.BodyStiffnessNPerM);
                }));
            }
            frames.Add(Make(FrameType.ToolState, flags, w =>
            {
                Write(w, state.PositionWorldM);
                Write(w, state.ProxyWorldM);
                Write(w, state.ForceWorldN);
                w.Write(state.Sequence);
                w.Write(state.ModelSequence);
                w.Write(state.Buttons);
                w.Write(state.Faults);
                Write(w, state.Contact == null ? 0.0 : state.Contact.Barycentric[2]);
            }));
            return frames;
        }
    }
}
