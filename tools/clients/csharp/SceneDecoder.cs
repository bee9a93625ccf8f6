// Puts a scene together from the frames that a client with Wants.Frames gets.
using System;
using System.Collections.Generic;

namespace Myotact
{
    public sealed class SceneDecoder
    {
        const double GridM = 1e-5;
        const byte LastOfScene = 1;

        struct Key
        {
            public uint Number;
            public int[] Places;
        }
        readonly Dictionary<int, Key> keys = new Dictionary<int, Key>();

        public ulong Sequence { get; private set; }
        public double TimeS { get; private set; }
        /// A muscle's skin: x y z of each vertex [m, world], in the order of its mesh.
        public double[][] SkinsWorldM { get; private set; } = new double[0][];
        /// A body's pose: 3x4 by rows, from the specimen's files to the world [m].
        public double[][] Poses { get; private set; } = new double[0][];

        /// True when the scene is whole with this frame; other frames change nothing. Throws WireException.
        public bool Take(Frame frame)
        {
            try
            {
                if (frame.Type == FrameType.SceneKey) TakeKey(frame.Payload);
                if (frame.Type == FrameType.SceneDelta) TakeDelta(frame.Payload);
                if (frame.Type == FrameType.BonePoses) TakePoses(frame.Payload);
            }
            catch (Exception failure) when (failure is ArgumentException || failure is IndexOutOfRangeException)
            {
                throw new WireException("a scene frame that is shorter than it says");
            }
            bool isPart = frame.Type > FrameType.SceneKey && frame.Type <= FrameType.Readings;
            return isPart && (frame.Flags & LastOfScene) != 0;
        }

        void TakeKey(byte[] payload)
        {
            var key = new Key { Number = BitConverter.ToUInt32(payload, 0), Places = new int[3 * CountOf(payload, 12)] };
            for (int i = 0; i < key.Places.Length; ++i) key.Places[i] = BitConverter.ToInt32(payload, 12 + 4 * i);
            keys[BitConverter.ToUInt16(payload, 4)] = key;
        }

        void TakeDelta(byte[] payload)
        {
            int skin = BitConverter.ToUInt16(payload, 4), skins = BitConverter.ToUInt16(payload, 6);
            var skinM = new double[3 * CountOf(payload, 3)];
            Key key;
            bool isKnown = keys.TryGetValue(skin, out key) && key.Number == BitConverter.ToUInt32(payload, 0);
            if (!isKnown || key.Places.Length != skinM.Length || skin >= skins)
                throw new WireException("a skin that refers to a key that did not come");
            int at = 12;
            for (int i = 0; i < skinM.Length; ++i) skinM[i] = GridM * (key.Places[i] + Varint(payload, ref at));
            if (SkinsWorldM.Length != skins) SkinsWorldM = new double[skins][];
            SkinsWorldM[skin] = skinM;
        }

        void TakePoses(byte[] payload)
        {
            Sequence = BitConverter.ToUInt64(payload, 0);
            TimeS = BitConverter.ToDouble(payload, 8);
            Poses = new double[BitConverter.ToUInt16(payload, 16)][];
            for (int body = 0; body < Poses.Length; ++body)
            {
                Poses[body] = new double[12];
                for (int i = 0; i < 12; ++i) Poses[body][i] = BitConverter.ToDouble(payload, 18 + 8 * (12 * body + i));
            }
        }

        /// Of vertices, which take so many bytes at least.
        static int CountOf(byte[] payload, int vertexBytes)
        {
            uint count = BitConverter.ToUInt32(payload, 8);
            if (count > payload.Length / vertexBytes) throw new WireException("more vertices than bytes");
            return (int)count;
        }

        static long Varint(byte[] payload, ref int at)
        {
            ulong zigzag = 0;
            int shift = 0;
            byte part;
            do
            {
                part = payload[at++];
                zigzag |= (ulong)(part & 0x7F) << shift;
                shift += 7;
            } while (part >= 0x80 && shift < 35);
            return (long)(zigzag >> 1) ^ -(long)(zigzag & 1);
        }
    }
}
